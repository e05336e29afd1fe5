#include "png/deflate_runs.h"

#include <gtest/gtest.h>
#include <libdeflate.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

using Bytes = std::vector<std::uint8_t>;

/// `bytes` as a stream of blocks of `block` bytes each.
std::string deflated(const Bytes& bytes, std::size_t period, std::size_t block) {
    std::string out;
    render::DeflateStream stream(out);
    for (std::size_t i = 0; i < bytes.size(); i += block)
        stream.add({&bytes[i], std::min(block, bytes.size() - i), period, i + block >= bytes.size()});
    return out;
}

/// All of `stream` is read, and gives all of `bytes`.
void expect_inflates(const std::string& stream, const Bytes& bytes, const std::string& what) {
    Bytes back(bytes.size());
    std::size_t read = 0, written = 0;
    libdeflate_decompressor* inflate = libdeflate_alloc_decompressor();
    EXPECT_EQ(libdeflate_deflate_decompress_ex(inflate, stream.data(), stream.size(), back.data(), back.size(), &read, &written),
              LIBDEFLATE_SUCCESS)
        << what;
    libdeflate_free_decompressor(inflate);
    EXPECT_EQ(read, stream.size()) << what;
    EXPECT_EQ(written, bytes.size()) << what;
    EXPECT_TRUE(back == bytes) << what;
}

/// Noise of few or many values, alternating with repetitions of the bytes `period` before.
Bytes stretches(std::size_t size, std::size_t period, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    Bytes bytes;
    while (bytes.size() < size) {
        const std::uint64_t length = random() % 600, values = std::uint64_t{1} << random() % 9;
        const bool repeat = random() % 2 == 0 && bytes.size() >= period;
        for (std::uint64_t i = 0; i < length && bytes.size() < size; ++i)
            bytes.push_back(repeat ? bytes[bytes.size() - period] : static_cast<std::uint8_t>(random() % values));
    }
    return bytes;
}

TEST(DeflateRuns, EveryByteSurvives) {
    for (const std::size_t period : {3, 4}) {
        for (std::size_t size = 1; size < 40; ++size)
            for (const std::size_t block : {1, 5, 100}) {
                const Bytes noise = stretches(size, size + 1, size), flat(size, 7);
                expect_inflates(deflated(noise, period, block), noise, "noise of " + std::to_string(size));
                expect_inflates(deflated(flat, period, block), flat, "flat of " + std::to_string(size));
            }
        for (std::uint64_t seed = 0; seed < 300; ++seed) {
            const Bytes bytes = stretches(1 + seed * seed, period, seed);
            expect_inflates(deflated(bytes, period, 20'000), bytes, "seed " + std::to_string(seed));
        }
    }
}

TEST(DeflateRuns, EveryLengthOfARunSurvives) {
    for (const std::size_t period : {3, 4})
        for (std::size_t run = 0; run < 600; ++run) {
            Bytes bytes{1, 2, 3, 4};
            for (std::size_t i = 0; i < run; ++i) bytes.push_back(bytes[bytes.size() - period]);
            bytes.insert(bytes.end(), 40, 9);
            for (std::uint8_t i = 0; i < 20; ++i) bytes.push_back(static_cast<std::uint8_t>(i * i));
            expect_inflates(deflated(bytes, period, bytes.size()), bytes, "run of " + std::to_string(run));
        }
}

/// Counts that grow like Fibonacci's numbers ask for words of more than 20 bits; the format has at most 15, the writer 14.
TEST(DeflateRuns, WordsStayShortWhateverTheCounts) {
    Bytes bytes;
    std::size_t count = 1, before = 1;
    for (std::uint8_t value = 0; value < 25; ++value) {
        bytes.insert(bytes.end(), count, value);
        before = std::exchange(count, count + before);
    }
    std::shuffle(bytes.begin(), bytes.end(), std::mt19937_64(1));
    const std::string stream = deflated(bytes, 3, bytes.size());
    expect_inflates(stream, bytes, "Fibonacci");
    EXPECT_LT(stream.size(), bytes.size() * 3 / 8);   // the entropy is 2.6 bits a byte
}

/// Bytes without order: what the code costs cannot be less than their entropy, and is hardly more.
TEST(DeflateRuns, TheCodeIsCloseToTheEntropy) {
    std::mt19937_64 random(5);
    Bytes bytes(200'000);
    for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(std::popcount(random()));   // binomial: 64 halves
    std::vector<double> counts(256);
    for (const std::uint8_t b : bytes) counts[b] += 1;
    double entropy = 0;
    for (const double n : counts)
        if (n > 0) entropy -= n * std::log2(n / static_cast<double>(bytes.size())) / 8;
    const auto size = static_cast<double>(deflated(bytes, 3, bytes.size()).size());
    EXPECT_GT(size, 0.999 * entropy);
    EXPECT_LT(size, 1.01 * entropy + 150);
}

TEST(DeflateRuns, NoiseGrowsByTheStatedBytesAtMost) {
    std::mt19937_64 random(6);
    for (const std::size_t size : {1, 100, 65'535, 65'536, 300'000}) {
        Bytes bytes(size);
        for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random());
        const std::string stream = deflated(bytes, 4, size);
        expect_inflates(stream, bytes, std::to_string(size));
        EXPECT_LE(stream.size(), size + 8 + 5 * ((size + 65'534) / 65'535));
    }
}

}   // namespace
