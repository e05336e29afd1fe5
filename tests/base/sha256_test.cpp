#include "base/sha256.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "temporary_folder.h"

using namespace meshfolio;

// The examples of FIPS 180-4 and of NIST's test vectors.
TEST(Sha256, KnownVectors) {
    EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(sha256(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, BytesAfterANulChangeTheDigest) { EXPECT_NE(sha256(std::string_view("a\0b", 3)), sha256(std::string_view("a\0c", 3))); }

TEST(Sha256, TheDigestOfAFileIsThatOfItsBytes) {
    const testing_tools::TemporaryFolder folder;
    for (const std::size_t size : {0, 1, 65535, 65536, 65537, 200000}) {
        std::string bytes(size, 'a');
        for (std::size_t i = 0; i < size; i += 7) bytes[i] = static_cast<char>(i);
        write_file(folder.path() / "file", bytes);
        EXPECT_EQ(sha256_of_file(folder.path() / "file"), sha256(bytes)) << size;
    }
    EXPECT_THROW(sha256_of_file(folder.path() / "none"), InputError);
    EXPECT_THROW(sha256_of_file(folder.path()), InputError) << "a folder";
}
