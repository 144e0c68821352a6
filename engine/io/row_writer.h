#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "core/parallel_for.h"
#include "io/atomic_file.h"

namespace meltpoint {

static_assert(std::endian::native == std::endian::little, "values are copied as they lie in memory");

/// Copies a value to a place in a row; returns the place behind it.
template <class T>
std::byte* put(std::byte* place, const T& value)
{
    std::memcpy(place, &value, sizeof(value));
    return place + sizeof(value);
}

/// Writes many rows, encoded on all cores, in chunks.
class RowWriter {
public:
    RowWriter(AtomicFile& file, const std::atomic<bool>* stop) : file_(&file), stop_(stop) {}

    /// Binary rows of one size: encode(place, i) fills row i. Returns false where it was stopped.
    template <class Encode>
    bool binary(std::size_t count, std::size_t row_bytes, const Encode& encode)
    {
        bytes_.resize(std::min(count, rows_a_chunk) * row_bytes);
        return chunks(count, [&](std::size_t begin, std::size_t rows) {
            parallel_for(rows, [&](std::size_t i) { encode(bytes_.data() + i * row_bytes, begin + i); });
            file_->write(std::span<const std::byte>(bytes_).first(rows * row_bytes));
        });
    }

    /// Lines of text: append(text, i) appends line i. Returns false where it was stopped.
    template <class Append>
    bool text(std::size_t count, const Append& append)
    {
        constexpr std::size_t lines_a_piece = 1024;
        std::vector<std::string> pieces(rows_a_chunk / lines_a_piece);
        return chunks(count, [&](std::size_t begin, std::size_t rows) {
            parallel_for((rows + lines_a_piece - 1) / lines_a_piece, [&](std::size_t piece) {
                pieces[piece].clear();
                const std::size_t end = std::min((piece + 1) * lines_a_piece, rows);
                for (std::size_t i = piece * lines_a_piece; i < end; ++i) {
                    append(pieces[piece], begin + i);
                }
            });
            for (std::string& piece : pieces) {
                file_->write(piece);
                piece.clear();
            }
        });
    }

private:
    static constexpr std::size_t rows_a_chunk = 65536;

    template <class WriteChunk>
    bool chunks(std::size_t count, const WriteChunk& write)
    {
        for (std::size_t begin = 0; begin < count; begin += rows_a_chunk) {
            if (stop_ != nullptr && *stop_) {
                return false;
            }
            write(begin, std::min(rows_a_chunk, count - begin));
        }
        return true;
    }

    AtomicFile* file_;
    const std::atomic<bool>* stop_;
    std::vector<std::byte> bytes_;
};

} // namespace meltpoint
