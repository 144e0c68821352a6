#include "io/obj_reduce.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>

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

/// The words of a line, as many as can matter: those of a vertex with its color.
struct Words {
    explicit Words(std::string_view line)
    {
        while (count < word.size() && !(word[count] = take_word(line)).empty()) {
            ++count;
        }
    }

    std::array<std::string_view, 6> word;
    std::size_t count = 0;
};

class ObjReducer {
public:
    ObjReducer(std::span<const std::uint8_t> bytes, const std::string& name)
        : text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()), name_(name)
    {
        out_.reserve(bytes.size());
    }

    std::vector<std::uint8_t> reduce()
    {
        for_each_line([this](std::string_view line) { find_colors(line); });
        for_each_line([this](std::string_view line) { add(line); });
        check_triangles(faces_, name_);
        return std::move(out_);
    }

private:
    /// Without comments; lines that end in a backslash are joined with the next.
    template <class Use>
    void for_each_line(const Use& use)
    {
        left_ = text_;
        line_number_ = 0;
        std::string joined;
        while (!left_.empty()) {
            std::string_view line = physical_line();
            if (continues(line)) {
                joined.clear();
                while (continues(line)) {
                    joined.append(line.substr(0, line.find_last_of('\\'))).push_back(' ');
                    line = physical_line();
                }
                line = joined.append(line);
            }
            use(line.substr(0, line.find('#')));
        }
    }

    std::string_view physical_line()
    {
        const std::size_t end = std::min(left_.find('\n'), left_.size());
        const std::string_view line = left_.substr(0, end);
        left_.remove_prefix(std::min(end + 1, left_.size()));
        ++line_number_;
        return line;
    }

    static bool continues(std::string_view line) { return line.ends_with('\\') || line.ends_with("\\\r"); }

    /// Whether there are colors, and what white is in them, can only be told from the whole file.
    void find_colors(std::string_view line)
    {
        if (take_word(line) != "v") {
            return;
        }
        const Words words(line);
        for (std::size_t i = 3; words.count == 6 && i < 6; ++i) {
            const double least_of_bytes = 2.0; // a little above 1 is a color from 0 to 1 that overshoots
            const bool is_bytes = to_number(words.word[i]).value_or(0.0) >= least_of_bytes;
            white_ = is_bytes ? 255.0 : white_.value_or(1.0);
        }
    }

    void add(std::string_view line)
    {
        const std::string_view keyword = take_word(line);
        if (keyword == "v") {
            add_vertex(Words(line));
        } else if (keyword == "vn") {
            add_vector("vn", Words(line));
            write("\n");
        } else if (keyword == "vt") {
            write("vt 0 0\n"); // faces count them
        } else if (keyword == "f") {
            add_face(line);
        }
    }

    /// x y z, then nothing, a weight that they are divided by (points in homogeneous coordinates), or a color.
    void add_vertex(const Words& words)
    {
        if (words.count == 5) {
            throw error("a vertex has two numbers behind its coordinates, where a color has three");
        }
        if (words.count == 4) {
            const double weight = coordinate(words.word[3]);
            write("v");
            for (std::size_t i = 0; i < 3; ++i) {
                write(fmt::format(" {}", static_cast<float>(coordinate(words.word[i]) / weight)));
            }
        } else {
            add_vector("v", words);
        }
        for (std::size_t i = 3; white_ && i < 6; ++i) {
            write(fmt::format(" {:.4f}", words.count == 6 ? channel(words.word[i]) : 1.0));
        }
        write("\n");
    }

    /// The first three numbers, in the file's own digits.
    void add_vector(std::string_view keyword, const Words& words)
    {
        if (words.count < 3) {
            throw error("a vertex or normal has fewer than three coordinates");
        }
        write(keyword);
        for (std::size_t i = 0; i < 3; ++i) {
            (void)coordinate(words.word[i]);
            write(" ");
            write(words.word[i]);
        }
    }

    [[nodiscard]] double coordinate(std::string_view word) const
    {
        const std::optional<double> value = to_number(word);
        if (!value) { // the importer would take it for zero
            throw error("a coordinate is not a number");
        }
        return *value;
    }

    /// Of a color, from 0 to 1.
    [[nodiscard]] double channel(std::string_view word) const
    {
        const std::optional<double> value = to_number(word);
        if (!value || !std::isfinite(*value)) {
            throw error("a color is not a finite number");
        }
        return std::clamp(*value / *white_, 0.0, 1.0);
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

    std::string_view text_;
    std::string_view left_; ///< of the text, in this pass over its lines
    const std::string& name_;
    std::vector<std::uint8_t> out_;
    std::optional<double> white_; ///< a channel of it, where the file has colors
    std::size_t line_number_ = 0;
    std::size_t faces_ = 0; ///< as triangles
};

} // namespace

std::vector<std::uint8_t> reduce_obj(std::span<const std::uint8_t> bytes, const std::string& name)
{
    return ObjReducer(bytes, name).reduce();
}

} // namespace meltpoint
