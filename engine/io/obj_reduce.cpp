#include "io/obj_reduce.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "io/mesh_limits.h"
#include "io/text_scanner.h"

namespace meltpoint {

namespace {

bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/// Takes the next word off the front of a line; empty at its end.
std::string_view take_word(std::string_view& line)
{
    const auto* const begin = std::find_if_not(line.begin(), line.end(), is_blank);
    const auto* const end = std::find_if(begin, line.end(), is_blank);
    const std::string_view word =
        line.substr(static_cast<std::size_t>(begin - line.begin()), static_cast<std::size_t>(end - begin));
    line.remove_prefix(static_cast<std::size_t>(end - line.begin()));
    return word;
}

class ObjReducer {
public:
    ObjReducer(std::span<const std::uint8_t> bytes, const std::string& name)
        : text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()), name_(name)
    {
        out_.reserve(bytes.size());
    }

    std::vector<std::uint8_t> reduce()
    {
        std::string joined;
        while (!text_.empty()) {
            std::string_view line = physical_line();
            if (continues(line)) {
                joined.clear();
                while (continues(line)) {
                    joined.append(line.substr(0, line.find_last_of('\\'))).push_back(' ');
                    line = physical_line();
                }
                line = joined.append(line);
            }
            add(line.substr(0, line.find('#')));
        }
        check_triangles(faces_, name_);
        return std::move(out_);
    }

private:
    std::string_view physical_line()
    {
        const std::size_t end = std::min(text_.find('\n'), text_.size());
        const std::string_view line = text_.substr(0, end);
        text_.remove_prefix(std::min(end + 1, text_.size()));
        ++line_number_;
        return line;
    }

    static bool continues(std::string_view line) { return line.ends_with('\\') || line.ends_with("\\\r"); }

    void add(std::string_view line)
    {
        const std::string_view keyword = take_word(line);
        if (keyword == "v") {
            add_vector("v", line, 4);
        } else if (keyword == "vn") {
            add_vector("vn", line, 3);
        } else if (keyword == "vt") {
            write("vt 0 0\n"); // faces count them
        } else if (keyword == "f") {
            add_face(line);
        }
    }

    /// Three numbers, or, for points in homogeneous coordinates, exactly four: what is more are colors.
    void add_vector(std::string_view keyword, std::string_view line, std::size_t most)
    {
        constexpr std::size_t enough = 5;
        std::array<std::string_view, enough> words;
        std::size_t count = 0;
        while (count < enough && !(words[count] = take_word(line)).empty()) {
            ++count;
        }
        if (count < 3) {
            throw error("a vertex or normal has fewer than three coordinates");
        }
        write(keyword);
        for (std::size_t i = 0; i < (count == most ? most : 3); ++i) {
            if (!to_number(words[i])) { // the importer would take it for zero
                throw error("a coordinate is not a number");
            }
            write(" ");
            write(words[i]);
        }
        write("\n");
    }

    void add_face(std::string_view line)
    {
        write("f");
        std::size_t corners = 0;
        for (std::string_view word = take_word(line); !word.empty(); word = take_word(line), ++corners) {
            char before = '/';
            for (const char c : word) {
                if (c == '0' ? before == '/' || before == '-' : (c < '1' || c > '9') && c != '/' && c != '-') {
                    throw error("a corner of a face is no index (they count from 1, or from -1 backward)");
                }
                before = c;
            }
            write(" ");
            write(word);
        }
        write("\n");
        if (corners < 3) {
            throw error("a face has fewer than three corners");
        }
        faces_ += corners - 2;
    }

    void write(std::string_view text) { out_.insert(out_.end(), text.begin(), text.end()); }

    [[nodiscard]] Error error(std::string_view message) const
    {
        return input_error("{}:{}: {}", name_, line_number_, message);
    }

    std::string_view text_; ///< what is left
    const std::string& name_;
    std::vector<std::uint8_t> out_;
    std::size_t line_number_ = 0;
    std::size_t faces_ = 0; ///< as triangles
};

} // namespace

std::vector<std::uint8_t> reduce_obj(std::span<const std::uint8_t> bytes, const std::string& name)
{
    return ObjReducer(bytes, name).reduce();
}

} // namespace meltpoint
