// Files of values, damaged in every place.
#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "damaged_bytes.h"
#include "mesh/small_meshes.h"
#include "run/one_mesh/fields.h"
#include "temporary_folder.h"

using namespace meshfolio;
using namespace meshfolio::run;
using testing_tools::for_each_damage;
using testing_tools::is_one_line_about;

TEST(DamagedValues, AreReadOrRefusedWithALine) {
    const PreparedMesh mesh = prepare_mesh({meshfolio::testing::tetrahedron(), "m.obj", {}, {}});
    const testing_tools::TemporaryFolder folder;
    const std::string file = (folder.path() / "v.csv").string();
    int refused = 0, taken = 0;
    for_each_damage("vertex,h\n0,1\n1,-2.5e1\n2,\n3,4\n", [&](const std::string& damaged) {
        write_file(file, damaged);
        try {
            const Field field = field_from_file(mesh, file + ":h");
            EXPECT_EQ(field.values.size(), 4);
            EXPECT_FALSE(field.values.array().isInf().any());
            ++taken;
        } catch (const InputError& error) {
            EXPECT_TRUE(is_one_line_about(file + ":", error.what()));
            EXPECT_NE(std::string(error.what()).find("; "), std::string::npos) << error.what();
            ++refused;
        }
    });
    EXPECT_GT(refused, 100);
    EXPECT_GT(taken, 10);
}

TEST(DamagedValues, ColumnsAreFoundByTheirWholeName) {
    const PreparedMesh mesh = prepare_mesh({meshfolio::testing::tetrahedron(), "m.obj", {}, {}});
    const testing_tools::TemporaryFolder folder;
    const std::string file = (folder.path() / "v:1.csv").string();   // the last colon separates the column
    write_file(file, "\xef\xbb\xbfh,hh,\r\n1,5,9\r\n2,6,9\r\n3,,9\r\n4,8,9\r\n");
    EXPECT_EQ(field_from_file(mesh, file + ":h").values, Vector((Vector(4) << 1, 2, 3, 4).finished()));
    EXPECT_TRUE(std::isnan(field_from_file(mesh, file + ":hh").values[2]));
    EXPECT_THROW(field_from_file(mesh, file + ":hhh"), InputError);
    EXPECT_THROW(field_from_file(mesh, file + ":"), UsageError);
    EXPECT_THROW(field_from_file(mesh, ":h"), UsageError);
}
