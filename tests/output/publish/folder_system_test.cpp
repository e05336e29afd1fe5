#include "output/publish/folder_system.h"

#include <gtest/gtest.h>

#include <string>

using meshfolio::output::is_safe_name;

TEST(SafeName, AcceptsPlainFileNames) {
    for (const char* name : {"a", "q4_torus_k5.ply", "q5_cube_lambda0.1_+x", "A-B_c.d"}) EXPECT_TRUE(is_safe_name(name)) << name;
}

TEST(SafeName, RefusesPathsAndOptions) {
    for (const char* name : {"", ".", "..", ".hidden", "-o", "a/b", "/a", "a\\b", "a b", "a\nb", "ü", "a:b", "a'b"}) {
        EXPECT_FALSE(is_safe_name(name)) << name;
    }
    EXPECT_FALSE(is_safe_name(std::string("a\0b", 3)));
    EXPECT_TRUE(is_safe_name(std::string(120, 'a')));
    EXPECT_FALSE(is_safe_name(std::string(121, 'a')));
}
