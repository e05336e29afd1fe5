#include "questions/core/mesh_library.h"

#include <gtest/gtest.h>

#include <set>
#include <thread>
#include <tuple>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/sha256.h"
#include "mesh/io/mesh_files.h"
#include "mesh/samples/sample_shapes.h"
#include "questions/core/mesh_roles.h"
#include "questions/core/section_tools.h"
#include "source_dir.h"
#include "temporary_folder.h"

using namespace meshfolio;
using testing_tools::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

fs::path put(const fs::path& path, const TriangleMesh& mesh) {
    fs::create_directories(path.parent_path());
    write_mesh(path, mesh);
    return path;
}

}   // namespace

TEST(MeshLibrary, EveryRoleHasABundledMesh) {
    const MeshLibrary library({}, {});
    std::set<std::string> names;
    for (const MeshRole& role : mesh_role_list()) {
        const auto mesh = library.role(std::string(role.role));
        EXPECT_GT(mesh->mesh().face_count(), 0);
        EXPECT_EQ(mesh->input.role, role.role);
        EXPECT_EQ(mesh->input.asked, role.asked);
        EXPECT_EQ(mesh->input.file, role.bundled);
        EXPECT_EQ(mesh->input.stand_in, !role.asked.empty());
        EXPECT_EQ(mesh->input.vertices, mesh->mesh().vertex_count());
        EXPECT_TRUE(mesh->prepared->warnings.empty()) << role.role;
        EXPECT_TRUE(names.insert(mesh->name).second) << mesh->name;
        EXPECT_EQ(mesh->input.sha256, sha256(read_file(fs::path(MESHFOLIO_SOURCE_DIR) / "data" / role.bundled)));
    }
}

TEST(MeshLibrary, UnknownRole) { EXPECT_THROW(MeshLibrary({}, {}).role("teapot"), UsageError); }

TEST(MeshLibrary, TheFirstDataFolderThatHasAMeshWins) {
    const TemporaryFolder folder;
    put(folder.path() / "a" / "curvatures" / "plane.obj", cube_mesh(1));
    put(folder.path() / "b" / "curvatures" / "plane.obj", cube_mesh(2));
    put(folder.path() / "b" / "armadillo.obj", cube_mesh(3));   // by its bare name
    const MeshLibrary library({folder.path() / "a", folder.path() / "b"}, {});
    EXPECT_EQ(library.role("plane")->mesh().vertex_count(), 8);
    EXPECT_FALSE(library.role("plane")->input.stand_in);
    EXPECT_EQ(library.role("plane")->input.file, "plane.obj");
    EXPECT_EQ(library.role("armadillo")->mesh().vertex_count(), cube_mesh(3).vertex_count());
    EXPECT_EQ(library.role("armadillo")->name, "armadillo");
    EXPECT_TRUE(library.role("lilium")->input.stand_in);
}

TEST(MeshLibrary, AMissingDataFolderIsAnInputError) {
    const TemporaryFolder folder;
    EXPECT_THROW(MeshLibrary({folder.path() / "none"}, {}), InputError);
}

TEST(MeshLibrary, OwnMeshesTakeEveryRoleAndGetNamesOfTheirOwn) {
    const TemporaryFolder folder;
    const auto a = put(folder.path() / "a" / "My Mesh.obj", cube_mesh(1)), b = put(folder.path() / "b" / "my-mesh.ply", cube_mesh(2));
    const MeshLibrary library({}, {a, b});
    const auto meshes = library.own_meshes();
    ASSERT_EQ(meshes.size(), 2u);
    EXPECT_EQ(meshes[0]->name, "my_mesh");
    EXPECT_EQ(meshes[1]->name, "my_mesh_2");
    EXPECT_EQ(library.role("plane"), meshes[0]);
}

TEST(MeshLibrary, OwnMeshesAreOpenedBeforeAnyWork) {
    const TemporaryFolder folder;
    const auto good = put(folder.path() / "good.obj", cube_mesh(1));
    const fs::path none = folder.path() / "god.obj", broken = folder.path() / "broken.obj";
    write_file(broken, "v 0 0 0\nf 1 2 3\n");
    const auto message_of = [](const MeshLibrary& library) {
        try {
            library.open_own_meshes();
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(message_of(MeshLibrary({}, {good})), "");
    const std::string missing = message_of(MeshLibrary({}, {good, none})), wrong = message_of(MeshLibrary({}, {broken, none}));
    EXPECT_TRUE(missing.starts_with(none.string() + ": ") && missing.ends_with("did you mean 'good.obj'?")) << missing;
    EXPECT_TRUE(wrong.starts_with(broken.string() + ":2: ")) << wrong;
}

TEST(MeshLibrary, FindsAnInputWithoutReadingTheMesh) {
    const TemporaryFolder folder;
    const fs::path data = folder.path() / "data", base = folder.path() / "here";
    put(data / "armadillo.obj", cube_mesh(2));
    const auto own = put(folder.path() / "own.obj", cube_mesh(1)), listed = put(base / "listed.obj", cube_mesh(3));
    using By = MeshLookup::By;
    const MeshLookup armadillo{.by = By::role, .name = "armadillo"}, file{.by = By::file, .path = "listed.obj"};
    const MeshLibrary bundled({}, {}, {"listed.obj"}), with_data({data}, {}), with_own({}, {own});
    const auto expect_same = [&](const report::Input& found, const report::Input& read) {
        EXPECT_EQ(std::tie(found.role, found.asked, found.file, found.sha256, found.stand_in),
                  std::tie(read.role, read.asked, read.file, read.sha256, read.stand_in));
    };
    expect_same(bundled.input_of(armadillo, base).value(), bundled.role("armadillo")->input);
    expect_same(with_data.input_of(armadillo, base).value(), with_data.role("armadillo")->input);
    EXPECT_NE(with_data.input_of(armadillo, base)->sha256, bundled.input_of(armadillo, base)->sha256);
    expect_same(bundled.input_of(file, base).value(), bundled.file("listed.obj", base)->input);
    expect_same(with_own.input_of({.by = By::own, .path = own}, base).value(), with_own.own_meshes().front()->input);
    EXPECT_FALSE(bundled.input_of({.by = By::file, .path = "missing.obj"}, base).has_value());
}

TEST(MeshLibrary, FilesAreFoundBesideTheSettingsThenInDataThenBundled) {
    const TemporaryFolder folder;
    put(folder.path() / "here" / "one.obj", cube_mesh(1));
    put(folder.path() / "data" / "one.obj", cube_mesh(2));
    put(folder.path() / "data" / "sub" / "two.obj", cube_mesh(2));
    const MeshLibrary library({folder.path() / "data"}, {});
    const fs::path base = folder.path() / "here";
    EXPECT_EQ(library.file("one.obj", base)->mesh().vertex_count(), 8);
    EXPECT_EQ(library.file("sub/two.obj", base)->mesh().vertex_count(), cube_mesh(2).vertex_count());
    EXPECT_EQ(library.file("torus", base)->mesh().X, library.role("torus")->mesh().X);
    EXPECT_FALSE(library.file("torus.obj", base)->input.stand_in);
    EXPECT_TRUE(library.file("decompose/armadillo.obj", base)->input.stand_in);
    EXPECT_THROW(library.file("teapot.obj", base), InputError);
}

// Another mesh in its place, unsaid, would be worse than none.
TEST(MeshLibrary, AnUnreadableFileIsNotSkipped) {
    const TemporaryFolder folder;
    const fs::path data = folder.path() / "data";
    fs::create_directories(data / "curvatures");
    fs::create_symlink("nowhere", data / "curvatures" / "plane.obj");
    fs::create_symlink("loop.obj", folder.path() / "loop.obj");
    put(data / "loop.obj", cube_mesh(1));
    const MeshLibrary library({data}, {});
    EXPECT_THROW(library.role("plane"), InputError);
    EXPECT_THROW(library.file("loop.obj", folder.path()), InputError);
    EXPECT_EQ(library.role("lilium")->input.file, "lily.obj");
}

TEST(MeshLibrary, ListedFilesOfOneStemHaveNamesInTheOrderListed) {
    const TemporaryFolder folder;
    put(folder.path() / "a" / "x.obj", cube_mesh(1));
    put(folder.path() / "b" / "x.obj", cube_mesh(2));
    const MeshLibrary library({}, {}, {"a/x.obj", "b/x.obj"});
    EXPECT_EQ(library.file("b/x.obj", folder.path())->name, "x_2") << "whoever is read first";
    EXPECT_EQ(library.file("a/x.obj", folder.path())->name, "x");
}

// The report must not tell where on this machine a mesh lies.
TEST(MeshLibrary, MessagesNameTheFileAsItWasAskedFor) {
    const TemporaryFolder folder;
    fs::create_directories(folder.path() / "curvatures");
    write_file(folder.path() / "curvatures" / "plane.obj", "v 0 0 nonsense\n");
    fs::create_directories(folder.path() / "decompose" / "armadillo.obj");
    const MeshLibrary library({folder.path()}, {});
    try {
        library.role("plane");
        FAIL() << "plane";
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).find(folder.path().string()), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find(".obj"), std::string::npos) << error.what();
    }
    EXPECT_TRUE(library.role("armadillo")->input.stand_in) << "a folder is no mesh";
}

TEST(MeshLibrary, EachMeshIsReadOnce) {
    const MeshLibrary library({}, {});
    std::vector<std::shared_ptr<const LibraryMesh>> seen(4);
    {
        std::vector<std::jthread> threads;
        for (auto& mesh : seen) threads.emplace_back([&library, &mesh] { mesh = library.role("torus"); });
    }
    for (const auto& mesh : seen) EXPECT_EQ(mesh, seen[0]);
}

TEST(ShortName, IsAnIdWhateverTheFileIsCalled) {
    EXPECT_EQ(short_name("x/Bumpy-Cube (2).obj"), "bumpy_cube_2");
    EXPECT_EQ(short_name("armadillo.obj"), "armadillo");
    EXPECT_EQ(short_name("__.obj"), "mesh");
    EXPECT_EQ(short_name("日本.obj"), "mesh");
    EXPECT_EQ(short_name("<script>.obj"), "script");
    EXPECT_EQ(short_name(std::string(300, 'a') + ".obj"), std::string(40, 'a'));
}

TEST(MeshLibrary, HandsOutOnlyTheRolesThatAChapterDeclares) {
    const MeshLibrary library({}, {}), offering = library.offering({"cube"});
    EXPECT_EQ(offering.role("cube"), library.role("cube")) << "read once";
    EXPECT_THROW(offering.role("torus"), std::logic_error);
    EXPECT_THROW(offering.limited_to(100).role("torus"), std::logic_error);
}

TEST(MeshLibrary, AnIdentityChangesWithTheMeshItsNameAndItsPlace) {
    const TemporaryFolder folder;
    const MeshLookup lookup{.by = MeshLookup::By::role, .name = "plane"};
    const auto identity = [&](const MeshLookup& l) { return MeshLibrary({folder.path()}, {}).identity_of(l, {}); };
    const std::string bundled = identity(lookup);
    EXPECT_EQ(bundled, identity(lookup));
    const fs::path file = put(folder.path() / "curvatures" / "plane.obj", make_sample("plane"));
    const std::string own = identity(lookup);
    EXPECT_NE(own, bundled) << "of a data folder, even with the same bytes: the report says so";
    write_file(file, read_file(file) + "# changed\n");
    EXPECT_NE(identity(lookup), own);
    const MeshLookup missing{.by = MeshLookup::By::file, .path = "missing.obj"};
    EXPECT_EQ(identity(missing).rfind("error ", 0), 0u);
}

// A copy is made once, keeps what a surface is, and says how far it lies away; a mesh that is small enough is itself.
TEST(MeshLibrary, ALargeMeshIsExploredOnADecimatedCopyThatTheSectionNames) {
    const TemporaryFolder folder;
    const fs::path large = put(folder.path() / "large.ply", icosphere(6)), small = put(folder.path() / "small.ply", icosphere(2));
    const MeshLibrary library({}, {large, small});
    const auto meshes = library.own_meshes();
    ASSERT_EQ(meshes.size(), 2u);
    QuestionSettings settings;
    report::Section whole, quick;
    EXPECT_EQ(meshes_for(library, settings, {}, whole), meshes);
    EXPECT_TRUE(whole.warnings.empty());
    const MeshLibrary limited = library.limited_to(10000);
    const auto explored = meshes_for(limited, settings, {}, quick);
    EXPECT_EQ(explored[1], meshes[1]);
    EXPECT_EQ(explored[0]->mesh().vertex_count(), 10000);
    EXPECT_TRUE(explored[0]->prepared->preflight.closed());
    EXPECT_EQ(explored[0], limited.own_meshes()[0]) << "made once";
    EXPECT_EQ(limited.limited_to(0).own_meshes(), meshes);
    EXPECT_GT(explored[0]->decimation_error, 1e-7);
    EXPECT_LT(explored[0]->decimation_error, 1e-3);
    ASSERT_EQ(quick.warnings.size(), 1u);
    EXPECT_NE(quick.warnings[0].find("large.ply: this section works on a decimated copy of 10\u202f000 of the 40\u202f962 vertices"),
              std::string::npos)
        << quick.warnings[0];
}
