#include "png/deflate_runs.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <span>
#include <vector>

namespace render {

namespace {

using std::size_t;
using std::uint32_t;
using std::uint64_t;
using std::uint8_t;

static_assert(std::endian::native == std::endian::little, "bits are written and bytes compared eight bytes at a time");

constexpr uint32_t symbols = 286, end_of_block = 256;
constexpr uint32_t longest_word = 14;   // four literals and the pending bits fit into 64 bits
constexpr uint32_t longest_run = 258;
constexpr size_t largest_stored = 65535;

/// `length` bits, the first one lowest.
struct Word {
    uint32_t bits = 0, length = 0;
};
using Counts = std::array<uint32_t, symbols>;
using Code = std::array<Word, symbols>;

struct RunLength {
    size_t symbol;
    Word extra;
};

/// Returns the symbol of a run's length and the bits that tell apart the lengths of that symbol (RFC 1951, 3.2.5).
RunLength run_length(uint32_t length) {
    if (length == longest_run) return {285, {}};
    const uint32_t n = length - 3, bits = n < 8 ? 0 : static_cast<uint32_t>(std::bit_width(n)) - 3;
    return {257 + 4 * bits + (n >> bits), {n & ((1U << bits) - 1), bits}};
}

uint64_t load8(const uint8_t* p) {
    uint64_t v;
    std::memcpy(&v, p, 8);
    return v;
}

struct Leaf {
    uint64_t weight = 0;
    size_t symbol = 0;
};

/// Sets the word lengths of the best prefix code of at most 14 bits: package-merge (Larmore and Hirschberg 1990). Level by level, the
/// leaves (symbols that occur) are merged with the pairs of the level below. The 2n − 2 lightest items of the top level stand for the code:
/// the length of a word is the number of levels in which they contain its leaf.
void choose_lengths(const Counts& counts, Code& code) {
    constexpr uint64_t infinite = uint64_t{1} << 48;
    std::vector<Leaf> leaves;   // at least two: the first byte of a block and its end
    for (size_t s = 0; s < symbols; ++s)
        if (counts[s] > 0) leaves.push_back({counts[s], s});
    std::ranges::stable_sort(leaves, {}, &Leaf::weight);
    const size_t n = leaves.size(), wanted = 2 * n - 2;
    leaves.push_back({infinite, 0});
    std::vector<uint64_t> below(wanted + 2, infinite), level(wanted + 2, infinite);
    std::array<std::array<bool, std::size_t{2} * symbols>, longest_word> is_leaf;
    size_t size = 0;
    for (auto& flags : is_leaf) {
        size = std::min(wanted, n + size / 2);
        for (size_t i = 0, leaf = 0, pair = 0; i < size; ++i) {
            const uint64_t package = below[pair] + below[pair + 1];
            flags[i] = leaves[leaf].weight <= package;
            level[i] = flags[i] ? leaves[leaf].weight : package;
            leaf += flags[i] ? 1 : 0;
            pair += flags[i] ? 0 : 2;
        }
        level[size] = infinite;
        std::swap(level, below);
    }
    size_t taken = wanted;
    for (auto flags = is_leaf.rbegin(); flags != is_leaf.rend(); ++flags) {
        const auto count = static_cast<size_t>(std::count(flags->begin(), flags->begin() + static_cast<std::ptrdiff_t>(taken), true));
        for (size_t i = 0; i < count; ++i) ++code[leaves[i].symbol].length;
        taken = 2 * (taken - count);
    }
}

/// Sets the bits of the words: consecutive numbers for each length, in the order of symbols, first bit highest (RFC 1951, 3.2.2).
void number_words(std::span<Word> code) {
    uint32_t next = 0;
    for (uint32_t length = 1; length <= longest_word; ++length, next <<= 1)
        for (Word& word : code) {
            if (word.length != length) continue;
            for (uint32_t i = 0; i < length; ++i) word.bits |= (next >> i & 1) << (length - 1 - i);
            ++next;
        }
}

/// Returns the header of a block with the word lengths of its code (RFC 1951, 3.2.7), themselves in a fixed code: five bits for 0 to 3,
/// four for 4 to 14 and for the three kinds of repetition (16, 17, 18). The two distances 3 and 4 take one bit each.
std::vector<Word> header_of(const Code& code, bool last) {
    std::vector<Word> header{{(last ? 1U : 0U) | 2U << 1 | (symbols - 257) << 3 | (4U - 1) << 8 | (19U - 4) << 13, 17}};
    std::array<Word, 19> lengths_code;
    for (uint32_t i = 0; i < 19; ++i) lengths_code[i].length = i < 4 ? 5 : i == 15 ? 0 : 4;
    for (const size_t i : {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15}) header.push_back({lengths_code[i].length, 3});
    number_words(lengths_code);

    std::array<uint32_t, symbols + 4> lengths{};
    std::transform(code.begin(), code.end(), lengths.begin(), [](const Word& word) { return word.length; });
    // cppcheck-suppress containerOutOfBounds ; it takes the size for `symbols`, without the 4
    lengths[symbols + 2] = lengths[symbols + 3] = 1;
    for (size_t i = 0, end = 0; i < lengths.size();) {
        const uint32_t length = lengths[i];
        while (end < lengths.size() && lengths[end] == length) ++end;
        const auto repeat = [&](size_t symbol, size_t least, size_t most, uint32_t extra_bits) {
            for (; end - i >= least; i += std::min(end - i, most)) {
                header.push_back(lengths_code[symbol]);
                header.push_back({static_cast<uint32_t>(std::min(end - i, most) - least), extra_bits});
            }
        };
        if (length == 0) repeat(18, 11, 138, 7), repeat(17, 3, 10, 3);
        if (i < end) header.push_back(lengths_code[length]), ++i;
        if (length > 0) repeat(16, 3, 6, 2);
    }
    return header;
}

/// A number of literal bytes, and of bytes after them that repeat the pixel before; the last piece of a block has no run.
struct Piece {
    uint32_t literals = 0, run = 0;
};

/// Splits bytes into pieces. Runs have at least eight bytes; their begin is searched once a pixel.
std::vector<Piece> pieces_of(const uint8_t* bytes, size_t size, size_t period) {
    std::vector<Piece> pieces;
    const auto repeats = [&](size_t i) { return bytes[i] == bytes[i - period]; };
    const auto repeating = [&](size_t i) {
        return static_cast<size_t>(std::countr_zero(load8(bytes + i) ^ load8(bytes + i - period))) / 8;
    };
    const auto repeats_32 = [&](size_t i) {
        uint64_t difference = 0;
        for (size_t k = i; k < i + 32; k += 8) difference |= load8(bytes + k) ^ load8(bytes + k - period);
        return difference == 0;
    };
    size_t done = 0;
    for (size_t i = period; i + 8 <= size;) {
        if (repeating(i) < 8) {
            i += period;
            continue;
        }
        size_t begin = i, end = i + 8;
        while (begin > std::max(done, period) && repeats(begin - 1)) --begin;
        const size_t limit = std::min(begin + longest_run, size);
        while (end + 32 <= size && end < limit && repeats_32(end)) end += 32;
        for (size_t more = 8; more == 8 && end + 8 <= size && end < limit; end += more) more = repeating(end);
        end = std::min(end, limit);
        pieces.push_back({static_cast<uint32_t>(begin - done), static_cast<uint32_t>(end - begin)});
        i = done = end;
    }
    pieces.push_back({static_cast<uint32_t>(size - done), 0});
    return pieces;
}

/// Counts the symbols. Uses four histograms of bytes, so that a count need not wait for that of an equal byte just before.
Counts counts_of(const uint8_t* bytes, const std::vector<Piece>& pieces) {
    Counts counts{};
    std::array<std::array<uint32_t, 256>, 4> parts{};
    for (const Piece& piece : pieces) {
        const uint8_t* const end = bytes + piece.literals;
        for (; end - bytes >= 4; bytes += 4)
            for (size_t i = 0; i < 4; ++i) ++parts[i][bytes[i]];
        while (bytes < end) ++parts[0][*bytes++];
        if (piece.run > 0) ++counts[run_length(piece.run).symbol];
        bytes += piece.run;
    }
    for (const auto& part : parts)
        for (size_t s = 0; s < part.size(); ++s) counts[s] += part[s];
    counts[end_of_block] = 1;
    return counts;
}

struct BitWriter {
    uint8_t* at;
    uint64_t bits;
    unsigned count;

    void put(Word word) {
        bits |= uint64_t{word.bits} << count;
        count += word.length;
    }
    /// Writes the full bytes, which leaves less than eight bits. Stores eight bytes, whatever their number.
    void flush() {
        std::memcpy(at, &bits, 8);
        at += count / 8;
        bits >>= count & ~7U;
        count &= 7;
    }
};

/// Writes the pieces and the end of the block. Takes the writer by value, so that the compiler keeps it in registers.
BitWriter written(BitWriter writer, const uint8_t* bytes, const std::vector<Piece>& pieces, const Code& code, size_t period) {
    const Word distance{period == 4 ? 1U : 0U, 1};
    for (const Piece& piece : pieces) {
        const uint8_t* const end = bytes + piece.literals;
        for (; end - bytes >= 4; bytes += 4) {
            for (size_t i = 0; i < 4; ++i) writer.put(code[bytes[i]]);
            writer.flush();
        }
        while (bytes < end) writer.put(code[*bytes++]);
        writer.flush();
        if (piece.run > 0) {
            const RunLength length = run_length(piece.run);
            writer.put(code[length.symbol]);
            writer.put(length.extra);
            writer.put(distance);
            writer.flush();
            bytes += piece.run;
        }
    }
    writer.put(code[end_of_block]);
    return writer;
}

}   // namespace

DeflatedBlock::DeflatedBlock(const uint8_t* bytes, size_t size, size_t period, bool last) : last_(last) {
    const std::vector<Piece> pieces = pieces_of(bytes, size, period);
    const Counts counts = counts_of(bytes, pieces);
    Code code{};
    choose_lengths(counts, code);
    number_words(code);
    const std::vector<Word> header = header_of(code, last);
    size_t most_bits = 6 * pieces.size();   // of runs: up to five bits more of the length, one of the distance
    for (const Word& word : header) most_bits += word.length;
    for (size_t s = 0; s < symbols; ++s) most_bits += size_t{counts[s]} * code[s].length;
    const size_t most = most_bits / 8;
    stored_ = most >= size + 5 * (size / largest_stored);
    if (stored_) {
        bits_.assign(reinterpret_cast<const char*>(bytes), size);
        return;
    }
    bits_.resize(most + 10);
    BitWriter writer{reinterpret_cast<uint8_t*>(bits_.data()), 0, 0};
    for (const Word& word : header) writer.put(word), writer.flush();
    writer = written(writer, bytes, pieces, code, period);
    spare_ = (8 - writer.count % 8) % 8;
    writer.count += spare_;
    writer.flush();
    bits_.resize(static_cast<size_t>(reinterpret_cast<char*>(writer.at) - bits_.data()));
}

void DeflateStream::add(const DeflatedBlock& block) {
    if (block.stored_) return add_stored(block.bits_, block.last_);
    const size_t begin = out_.size();
    out_.resize(begin + block.bits_.size() + 9);
    BitWriter writer{reinterpret_cast<uint8_t*>(out_.data()) + begin, pending_, pending_count_};
    const auto* const bits = reinterpret_cast<const uint8_t*>(block.bits_.data());
    size_t i = 0;
    for (; i + 8 < block.bits_.size(); i += 8, writer.at += 8) {   // not the last byte, which may be incomplete
        const uint64_t some = load8(bits + i), joined = writer.bits | some << writer.count;
        std::memcpy(writer.at, &joined, 8);
        writer.bits = writer.count > 0 ? some >> (64 - writer.count) : 0;
    }
    for (; i < block.bits_.size(); i += 4) {
        const size_t count = std::min<size_t>(4, block.bits_.size() - i);
        uint32_t some = 0;
        std::memcpy(&some, bits + i, count);
        writer.put({some, static_cast<uint32_t>(8 * count)});
        if (i + count == block.bits_.size()) writer.count -= block.spare_;
        writer.flush();
    }
    if (block.last_) writer.count += 7, writer.flush();   // the remaining bits get their own byte
    pending_ = writer.bits, pending_count_ = writer.count;
    out_.resize(static_cast<size_t>(reinterpret_cast<char*>(writer.at) - out_.data()));
}

/// Appends the bytes as they are, each part after its length and the complement of its length (RFC 1951, 3.2.4).
void DeflateStream::add_stored(std::string_view bytes, bool last) {
    while (!bytes.empty()) {
        const size_t part = std::min(bytes.size(), largest_stored);
        pending_ |= uint64_t{last && part == bytes.size() ? 1U : 0U} << pending_count_;
        for (unsigned written = 0; written < pending_count_ + 3; written += 8) out_ += static_cast<char>(pending_ >> written);
        pending_ = pending_count_ = 0;
        for (const size_t length : {part, ~part}) out_ += {static_cast<char>(length), static_cast<char>(length >> 8)};
        out_ += bytes.substr(0, part);
        bytes.remove_prefix(part);
    }
}

}   // namespace render
