#include "io/gltf_buffer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <system_error>

#include "core/error.h"
#include "io/input_file.h"

namespace meltpoint {

namespace {

constexpr std::uint8_t no_digit = 64;

constexpr std::array<std::uint8_t, 256> base64_values()
{
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<std::uint8_t, 256> values{};
    values.fill(no_digit);
    for (std::size_t i = 0; i < digits.size(); ++i) {
        values.at(static_cast<unsigned char>(digits[i])) = static_cast<std::uint8_t>(i);
    }
    return values;
}

/// RFC 4648, with or without padding.
std::vector<std::uint8_t> decode_base64(std::string_view text, const std::filesystem::path& path)
{
    constexpr std::array<std::uint8_t, 256> values = base64_values();
    text = text.substr(0, text.find('='));
    std::vector<std::uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int bit_count = 0;
    for (const char c : text) {
        const std::uint8_t value = values.at(static_cast<unsigned char>(c));
        if (value == no_digit) {
            throw input_error("{}: a buffer's data URI is not base64", path.string());
        }
        bits = bits << 6 | value;
        bit_count += 6;
        if (bit_count >= 8) {
            bit_count -= 8;
            bytes.push_back(static_cast<std::uint8_t>(bits >> bit_count));
        }
    }
    return bytes;
}

/// "my%20mesh.bin" is the file "my mesh.bin".
std::string decode_percent(const std::string& uri)
{
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned value = 0;
        const char* const digits = uri.data() + i + 1;
        if (uri[i] == '%' && i + 2 < uri.size() && std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
            text.push_back(static_cast<char>(value));
            i += 2;
        } else {
            text.push_back(uri[i]);
        }
    }
    return text;
}

} // namespace

std::vector<std::uint8_t> read_gltf_buffer(const std::string& uri, const std::filesystem::path& path)
{
    if (uri.starts_with("data:")) {
        constexpr std::string_view marker = ";base64,";
        const std::size_t begin = uri.find(marker);
        if (begin == std::string::npos) {
            throw input_error("{}: a buffer's data URI is not base64", path.string());
        }
        return decode_base64(std::string_view(uri).substr(begin + marker.size()), path);
    }

    namespace fs = std::filesystem;
    std::error_code error;
    const fs::path folder = fs::weakly_canonical(fs::absolute(path).parent_path(), error);
    const std::string name = decode_percent(uri);
    constexpr std::size_t longest_name = 255;
    const bool is_text =
        name.size() <= longest_name && std::none_of(name.begin(), name.end(), [](unsigned char c) { return c < ' '; });
    const fs::path file = error || !is_text ? fs::path() : fs::weakly_canonical(folder / name, error);
    const auto [folder_end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    if (error || folder_end != folder.end() || rest == file.end()) {
        throw input_error("{}: a buffer is not in a file beside it or in a folder below", path.string());
    }
    try {
        return read_input_file(file);
    } catch (const Error& reason) {
        throw input_error("{}: a buffer is missing: {}", path.string(), reason.what());
    }
}

} // namespace meltpoint
