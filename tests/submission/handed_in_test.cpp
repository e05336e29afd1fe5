#include "submission/handed_in.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "base/errors.h"
#include "temporary_folder.h"

using namespace meshfolio;
using submission::HandedIn;
using submission::HandInLimits;
using submission::read_handed_in;
using testing_tools::TemporaryFolder;

namespace {

std::string refusal_of(const std::filesystem::path& path, const HandInLimits& limits = {}) {
    try {
        read_handed_in(path, limits);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

void append_number(std::string& bytes, std::uint64_t number, int length) {
    for (int i = 0; i < length; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xff);
}

std::uint32_t crc_of(const std::string& bytes) {
    std::uint32_t crc = 0xffffffff;
    for (const unsigned char byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320 : 0);
    }
    return ~crc;
}

/// Returns a zip of one stored file, made by the specification of the format. @param mode  of Unix, in the external attributes
std::string zip_of(const std::string& name, const std::string& bytes, std::uint32_t mode = 0100644) {
    std::string common;   // fields of both headers, from "version needed" on
    append_number(common, 20, 2);
    append_number(common, 0, 2 + 2);
    append_number(common, 0x00210000, 4);   // 1 January 1980
    append_number(common, crc_of(bytes), 4);
    append_number(common, static_cast<std::uint32_t>(bytes.size()), 4);
    append_number(common, static_cast<std::uint32_t>(bytes.size()), 4);
    append_number(common, static_cast<std::uint32_t>(name.size()), 2);
    append_number(common, 0, 2);
    std::string zip = "PK\x03\x04" + common + name + bytes;
    std::string central = "PK\x01\x02";
    append_number(central, 20 | 3 << 8, 2);   // made by Unix
    central += common;
    append_number(central, 0, 2 + 2 + 2);
    append_number(central, mode << 16, 4);
    append_number(central, 0, 4);
    central += name;
    std::string end = "PK\x05\x06";
    append_number(end, 0, 4);
    append_number(end, 1, 2);
    append_number(end, 1, 2);
    append_number(end, static_cast<std::uint32_t>(central.size()), 4);
    append_number(end, static_cast<std::uint32_t>(zip.size()), 4);
    append_number(end, 0, 2);
    return zip + central + end;
}

std::string refusal_of_zip(const std::string& zip, const HandInLimits& limits = {}) {
    const TemporaryFolder folder;
    return refusal_of(folder.write("ada.zip", zip), limits);
}

}   // namespace

TEST(HandedIn, AFolderAndAZipGiveTheSameFiles) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() / "ada/q4");
    folder.write("ada/q4/a.PLY", "ply");
    folder.write("ada/notes.pdf", "not read");
    EXPECT_EQ(read_handed_in(folder.path() / "ada"), (HandedIn{{"a.PLY", "ply"}}));
    EXPECT_EQ(read_handed_in(folder.write("b.zip", zip_of("h.csv", "1"))), (HandedIn{{"h.csv", "1"}}));
    EXPECT_EQ(read_handed_in(folder.write("c.zip", zip_of("ada/h.csv", "1"))), (HandedIn{{"h.csv", "1"}})) << "the folder itself packed";
    EXPECT_TRUE(read_handed_in(folder.write("d.zip", zip_of("run.sh", "#!"))).empty());
}

TEST(HandedIn, MaliciousPathsAreRefusedWithTheReason) {
    EXPECT_NE(refusal_of_zip(zip_of("../h.csv", "1")).find("leads outside"), std::string::npos);
    EXPECT_NE(refusal_of_zip(zip_of("a/../../h.csv", "1")).find("leads outside"), std::string::npos);
    EXPECT_NE(refusal_of_zip(zip_of("/etc/h.csv", "1")).find("absolute"), std::string::npos);
    EXPECT_NE(refusal_of_zip(zip_of("..\\..\\h.csv", "1")), "") << "of Windows";
    EXPECT_NE(refusal_of_zip(zip_of(std::string(2000, 'x') + ".csv", "1")).find("2004 bytes"), std::string::npos);
    EXPECT_EQ(refusal_of_zip(zip_of("gr\u00f6\u00dfe.csv", "1")), "");
    EXPECT_NE(refusal_of_zip(zip_of("h.csv", "/etc/passwd", 0120777)).find("is a link"), std::string::npos);
    EXPECT_EQ(refusal_of_zip(zip_of("a..b/h.csv", "1")), "");
}

TEST(HandedIn, LinksInAFolderAreRefused) {
    const TemporaryFolder folder;
    std::filesystem::create_symlink("/etc/passwd", folder.path() / "h.csv");
    EXPECT_NE(refusal_of(folder.path()).find("is a link"), std::string::npos);
}

TEST(HandedIn, FilesBeyondALimitAreRefused) {
    const std::string zip = zip_of("h.csv", std::string(1000, '1'));
    EXPECT_EQ(refusal_of_zip(zip), "");
    EXPECT_NE(refusal_of_zip(zip, {.largest_file = 999}).find("is larger"), std::string::npos);
    EXPECT_NE(refusal_of_zip(zip, {.largest_ratio = 0.5, .ratio_from = 0}).find("zip bomb"), std::string::npos);
    EXPECT_NE(refusal_of_zip(zip, {.most_entries = 0}).find("entries"), std::string::npos);
}

TEST(HandedIn, AFileThatIsNoZipIsRefusedByName) {
    EXPECT_NE(refusal_of_zip("no zip at all").find("ada.zip"), std::string::npos);
    EXPECT_NE(refusal_of_zip(zip_of("h.csv", "12345").substr(0, 30)).find("ada.zip"), std::string::npos);
}
