/// @file
/// Deflate (RFC 1951) for filtered pictures: bytes by Huffman code, and runs of one repeating pixel. No other matches are looked for:
/// behind the Paeth filter a search takes three times as long and shortens a shaded surface by a few percent or not at all.
/// Beside libdeflate because `render armadillo.obj` takes 1.5 times its processor time with that at level 1 (0.48 s instead of 0.31 s).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace render {

/// A block, which refers to nothing before it: blocks can be made side by side, and are then put one after the other.
class DeflatedBlock {
public:
    /// @param period  bytes of a pixel, 3 or 4; @param last  it ends the stream
    DeflatedBlock(const std::uint8_t* bytes, std::size_t size, std::size_t period, bool last);

    /// Bytes that it adds to a stream, at most.
    std::size_t largest_size() const { return bits_.size() + bits_.size() / 65535 * 5 + 16; }

private:
    friend class DeflateStream;

    std::string bits_;             // lowest first
    unsigned spare_ = 0;           // of the bits of the last byte
    bool last_, stored_ = false;   // stored: the bytes as they are
};

class DeflateStream {
public:
    /// Appends to `out`.
    explicit DeflateStream(std::string& out) : out_(out) {}

    /// At most 8 bytes, and 5 for every 64 kB, longer than what the block holds.
    void add(const DeflatedBlock& block);

private:
    void add_stored(std::string_view bytes, bool last);

    std::string& out_;
    std::uint64_t pending_ = 0;   // bits that do not fill a byte yet
    unsigned pending_count_ = 0;
};

}   // namespace render
