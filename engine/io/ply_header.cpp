#include "io/ply_header.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "io/text_scanner.h"

namespace meltpoint {

namespace {

constexpr std::size_t longest_header = std::size_t{1} << 20; // bytes
constexpr std::size_t most_properties = 1000;                // of all elements together

PlyType type_of(const TextScanner& text, std::string_view word)
{
    constexpr std::array<std::pair<std::string_view, PlyType>, 16> types{{{"char", PlyType::Int8},
                                                                          {"int8", PlyType::Int8},
                                                                          {"uchar", PlyType::Uint8},
                                                                          {"uint8", PlyType::Uint8},
                                                                          {"short", PlyType::Int16},
                                                                          {"int16", PlyType::Int16},
                                                                          {"ushort", PlyType::Uint16},
                                                                          {"uint16", PlyType::Uint16},
                                                                          {"int", PlyType::Int32},
                                                                          {"int32", PlyType::Int32},
                                                                          {"uint", PlyType::Uint32},
                                                                          {"uint32", PlyType::Uint32},
                                                                          {"float", PlyType::Float32},
                                                                          {"float32", PlyType::Float32},
                                                                          {"double", PlyType::Float64},
                                                                          {"float64", PlyType::Float64}}};
    const auto* const found =
        std::find_if(types.begin(), types.end(), [&](const auto& type) { return type.first == word; });
    if (found == types.end()) {
        throw text.error("a property has no type that PLY knows");
    }
    return found->second;
}

PlyEncoding encoding_of(const TextScanner& text, std::string_view word)
{
    if (word == "ascii") {
        return PlyEncoding::Ascii;
    }
    if (word == "binary_little_endian") {
        return PlyEncoding::LittleEndian;
    }
    if (word == "binary_big_endian") {
        return PlyEncoding::BigEndian;
    }
    throw text.error("the format is none of ascii, binary_little_endian and binary_big_endian");
}

PlyProperty read_property(TextScanner& text)
{
    PlyProperty property;
    std::string_view type = text.word_on_line();
    if (type == "list") {
        property.count_type = type_of(text, text.word_on_line());
        if (*property.count_type == PlyType::Float32 || *property.count_type == PlyType::Float64) {
            throw text.error("the length of a list is no whole number");
        }
        type = text.word_on_line();
    }
    property.type = type_of(text, type);
    property.name = text.word_on_line();
    if (property.name.empty()) {
        throw text.error("a property has no name");
    }
    return property;
}

/// The fewest bytes that one element can take.
std::size_t least_size(const PlyElement& element, PlyEncoding encoding)
{
    std::size_t size = 0;
    for (const PlyProperty& property : element.properties) {
        size += encoding == PlyEncoding::Ascii ? 2 // a digit and a blank
                                               : byte_size(property.count_type.value_or(property.type));
    }
    return size;
}

void check_counts(const PlyHeader& header, std::size_t file_size, const std::string& name)
{
    // One byte more: the blank after an ASCII file's last value may be missing.
    std::uint64_t left = file_size - header.size + (header.encoding == PlyEncoding::Ascii ? 1 : 0);
    for (const PlyElement& element : header.elements) {
        const std::size_t least = least_size(element, header.encoding);
        if (least > 0 && element.count > left / least) {
            throw input_error("{}: the header announces {} elements of \"{}\", more than the file's {} bytes can hold",
                              name, element.count, element.name, file_size);
        }
        left -= element.count * least;
    }
}

/// The text of the header, its last line included.
std::span<const std::uint8_t> header_text(std::span<const std::uint8_t> bytes, const std::string& name)
{
    const std::string_view begin(reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), longest_header));
    if (!begin.starts_with("ply\n") && !begin.starts_with("ply\r\n")) {
        throw input_error("{}: this is not a PLY file, which begins with \"ply\" on a line of its own", name);
    }
    const std::size_t last_line = begin.find("\nend_header");
    const std::size_t end = last_line == std::string_view::npos ? last_line : begin.find('\n', last_line + 1);
    if (end == std::string_view::npos) {
        throw input_error("{}: the header of the PLY file has no end", name);
    }
    return bytes.first(end + 1);
}

} // namespace

std::size_t byte_size(PlyType type)
{
    constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
    return sizes.at(static_cast<std::size_t>(type));
}

PlyHeader read_ply_header(std::span<const std::uint8_t> bytes, const std::string& name)
{
    const std::span<const std::uint8_t> header_bytes = header_text(bytes, name);
    PlyHeader header;
    header.size = header_bytes.size();
    TextScanner text(header_bytes, name);
    bool has_format = false;
    std::size_t properties = 0;
    for (header.lines = 1; text.next_line(); ++header.lines) {
        const std::string_view keyword = text.word_on_line();
        if (keyword == "format") {
            header.encoding = encoding_of(text, text.word_on_line());
            has_format = true;
        } else if (keyword == "element") {
            PlyElement element;
            element.name = text.word_on_line();
            element.count = text.count(text.word_on_line(), "the number of elements");
            const bool known = std::any_of(header.elements.begin(), header.elements.end(),
                                           [&](const PlyElement& other) { return other.name == element.name; });
            if (known) {
                throw text.error("there are two elements of one name");
            }
            header.elements.push_back(std::move(element));
        } else if (keyword == "property") {
            if (header.elements.empty() || ++properties > most_properties) {
                throw text.error("a property without an element, or one too many");
            }
            header.elements.back().properties.push_back(read_property(text));
        } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info" && keyword != "end_header") {
            throw text.error("the header has a line that PLY does not know");
        }
    }
    if (!has_format) {
        throw input_error("{}: the header of the PLY file names no format", name);
    }
    check_counts(header, bytes.size(), name);
    return header;
}

bool has_faces(const PlyHeader& header)
{
    return std::any_of(header.elements.begin(), header.elements.end(), [](const PlyElement& element) {
        return (element.name == "face" || element.name == "tristrips") && element.count > 0;
    });
}

} // namespace meltpoint
