#include "base/nearest_word.h"

#include <gtest/gtest.h>

using meshfolio::near_words;
using meshfolio::nearest_word;

TEST(NearestWord, FewestEditsWin) {
    const std::vector<std::string> known{"title", "author", "template", "size"};
    EXPECT_EQ(nearest_word("titel", known), "title");
    EXPECT_EQ(nearest_word("tmplate", known), "template");
    EXPECT_EQ(nearest_word("sizes", known), "size");
    EXPECT_EQ(nearest_word("title", known), "title");
}

TEST(NearestWord, NeighboursExchangedAreOneEdit) {
    EXPECT_EQ(near_words("tua", {"raw", "tau", "h2"}), std::vector<std::string>{"tau"});
    EXPECT_EQ(near_words("--cvs", {"--csv", "--ply", "--out"}), std::vector<std::string>{"--csv"});
    EXPECT_EQ(near_words("ta", {"at"}), std::vector<std::string>()) << "one letter in two is too much";
}

TEST(NearestWord, TheFirstOnATie) { EXPECT_EQ(nearest_word("c", {"a", "b"}), "a"); }

TEST(NearestWord, NothingKnownGivesNothing) { EXPECT_EQ(nearest_word("word", {}), ""); }

TEST(NearestWord, ThoseThatMayHaveBeenMeantAreNearAndFew) {
    const std::vector<std::string> known{"torus.obj", "tours.obj", "torus2.obj", "toru.objj", "terse.obj", "cube.obj"};
    EXPECT_EQ(near_words("torus.objj", known), (std::vector<std::string>{"toru.objj", "torus.obj", "torus2.obj"}));
    EXPECT_EQ(near_words("sphere", {"cube", "plane"}), std::vector<std::string>());
}
