#include "run/batch/mesh_list.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "output/publish/folder_system.h"
#include "output/publish/publish.h"
#include "run/batch/batch_folder.h"
#include "temporary_folder.h"

namespace meshfolio::run {
namespace {

std::vector<std::string> files_of(const std::vector<BatchMesh>& meshes, const std::filesystem::path& folder) {
    std::vector<std::string> files;
    for (const BatchMesh& mesh : meshes) files.push_back(std::filesystem::path(mesh.file).lexically_relative(folder).string());
    return files;
}

class MeshLists : public ::testing::Test {
protected:
    const testing_tools::TemporaryFolder place;
    const std::filesystem::path& folder = place.path();

    void SetUp() override {
        for (const char* name : {"b.obj", "a.PLY", "notes.txt", ".hidden.obj"}) place.write(name, "x");
        for (const char* sub : {"sub", "report", "batch", ".git"}) {
            output::make_folder(folder / sub);
            place.write(std::string(sub) + "/c.off", "x");
        }
        place.write("report/.meshfolio", output::report_folder.contents);
        place.write(std::string("batch/") + output::batch_folder.marker, output::batch_folder.contents);
    }
    std::vector<std::string> named(const std::vector<std::string>& words, const std::vector<std::string>& lists = {}) const {
        return files_of(batch_meshes(words, lists, folder / "out"), folder);
    }
};

TEST_F(MeshLists, AFolderStandsForItsMeshesButForNoOutputOfOurs) {
    EXPECT_EQ(named({folder.string()}), (std::vector<std::string>{"a.PLY", "b.obj", "sub/c.off"}));
}

TEST_F(MeshLists, EachMeshIsTakenOnceInTheOrderOfItsFirstName) {
    const std::string b = (folder / "b.obj").string();
    EXPECT_EQ(named({b, folder.string(), (folder / "sub" / ".." / "b.obj").string(), (folder / "*.PLY").string()}),
              (std::vector<std::string>{"b.obj", "a.PLY", "sub/c.off"}));
}

TEST_F(MeshLists, APatternMatchesMeshesOnly) { EXPECT_EQ(named({(folder / "*").string()}), (std::vector<std::string>{"a.PLY", "b.obj"})); }

TEST_F(MeshLists, AListIsRelativeToItsOwnFolder) {
    place.write("sub/list", "# first\n\n c.off \r\n../b.obj");
    const std::string list = (folder / "sub/list").string();
    for (const auto& meshes : {batch_meshes({"@" + list}, {}, "out"), batch_meshes({}, {list}, "out")}) {
        ASSERT_EQ(meshes.size(), 2u);
        EXPECT_EQ(meshes[0].name, "c");
        EXPECT_EQ(meshes[1].name, "b");
    }
}

TEST_F(MeshLists, WhatIsNotThereIsRefusedWithItsLine) {
    place.write("list", "b.obj\nnone.obj\n");
    try {
        named({}, {(folder / "list").string()});
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("list:2: "), std::string::npos) << error.what();
    }
    output::make_folder(folder / "nothing");
    for (const char* missing : {"c.obj", "*.stl", "nothing", "@none"})
        EXPECT_THROW(named({(missing[0] == '@' ? "@" : "") + (folder / (missing[0] == '@' ? missing + 1 : missing)).string()}), InputError)
            << missing;
    EXPECT_THROW(named({}), UsageError);
}

TEST_F(MeshLists, MeshesInTheOutputFolderAreRefused) {
    EXPECT_THROW(batch_meshes({(folder / "sub/c.off").string()}, {}, folder / "sub"), UsageError);
    EXPECT_THROW(batch_meshes({(folder / "sub/c.off").string()}, {}, folder / "sub" / ".." / "sub"), UsageError);
}

TEST(FolderNames, AreSafeAndEachIsOnce) {
    const std::vector<std::string> names = folder_names(
        {"x/bunny.obj", "y/Bunny.ply", "bunny-2.off", "-x.obj", "..", "a b/ä.v2.obj", "bunny.stl", std::string(300, 'n') + ".obj"});
    EXPECT_EQ(names[0], "bunny");
    EXPECT_EQ(names[1], "Bunny-2");
    EXPECT_EQ(names[2], "bunny-2-2");
    EXPECT_EQ(names[3], "_x");
    EXPECT_EQ(names[6], "bunny-3");
    for (const std::string& name : names) {
        EXPECT_TRUE(output::is_safe_name(name)) << name;
        EXPECT_EQ(name.find('.'), std::string::npos) << name;   // index.html, x.failed and x.tmp-1 are never among them
    }
}

TEST(BatchFolders, AreOursOrNew) {
    const testing_tools::TemporaryFolder place;
    place.write("other", "x");
    EXPECT_THROW(BatchFolder(place.path()), OutputError);
    EXPECT_THROW(BatchFolder(place.path() / "other"), OutputError);
    { const BatchFolder first(place.path() / "new" / "folder"); }
    const BatchFolder again(place.path() / "new" / "folder");
    EXPECT_THROW(BatchFolder(place.path() / "new" / "folder"), OutputError);   // another run is there
}

TEST(BatchFolders, MayHoldReportsBefore) {
    const testing_tools::TemporaryFolder place;
    const std::filesystem::path report = place.path() / "reports" / "merged";
    output::make_folder(report);
    EXPECT_THROW(BatchFolder(report.parent_path()), OutputError);
    place.write(std::string("reports/merged/") + output::marker_file, output::report_folder.contents);
    const BatchFolder folder(report.parent_path());
    EXPECT_TRUE(std::filesystem::exists(report.parent_path() / output::batch_folder.marker));
}

}   // namespace
}   // namespace meshfolio::run
