/// @file
/// Deflate (RFC 1951) for filtered pictures: bytes by Huffman code, and runs of one repeating pixel. No other matches are looked for:
/// behind the Paeth filter a search takes three times as long and shortens a shaded surface by a few percent or not at all.
/// Beside libdeflate because `render armadillo.obj` takes 1.5 times its processor time with that at level 1 (0.48 s instead of 0.31 s).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace render {

class RunDeflater {
public:
    /// Appends to `out`. @param period  bytes of a pixel, 3 or 4
    RunDeflater(std::string& out, std::size_t period) : out_(out), period_(period) {}

    /// One block, which refers to nothing before it; at most 8 bytes, and 5 for every 64 kB, longer than what it holds.
    /// The last one ends the stream.
    void add_block(const std::uint8_t* bytes, std::size_t size, bool last);

private:
    void add_stored(const std::uint8_t* bytes, std::size_t size, bool last);

    std::string& out_;
    std::size_t period_;
    std::uint64_t pending_ = 0;   // bits that do not fill a byte yet
    unsigned pending_count_ = 0;
};

}   // namespace render
