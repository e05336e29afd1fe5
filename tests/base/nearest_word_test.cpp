#include "base/nearest_word.h"

#include <gtest/gtest.h>

using meshfolio::nearest_word;
using meshfolio::suggestion;

TEST(NearestWord, TheFewestEditsWin) {
    const std::vector<std::string> known{"title", "author", "template", "size"};
    EXPECT_EQ(nearest_word("titel", known), "title");
    EXPECT_EQ(nearest_word("tmplate", known), "template");
    EXPECT_EQ(nearest_word("sizes", known), "size");
    EXPECT_EQ(nearest_word("title", known), "title");
}

TEST(NearestWord, AnExchangeOfNeighboursIsOneEdit) {
    EXPECT_EQ(suggestion("tua", {"raw", "tau", "h2"}), "did you mean 'tau'? ");
    EXPECT_EQ(suggestion("--cvs", {"--csv", "--ply", "--out"}), "did you mean '--csv'? ");
    EXPECT_EQ(suggestion("ta", {"at"}), "") << "one wrong letter in two is too much";
}

TEST(NearestWord, TheFirstWinsOnATie) { EXPECT_EQ(nearest_word("c", {"a", "b"}), "a"); }

TEST(NearestWord, NoKnownWordGivesNothing) { EXPECT_EQ(nearest_word("word", {}), ""); }

TEST(NearestWord, ASuggestionHasThreeSimilarWordsAtMost) {
    const std::vector<std::string> known{"torus.obj", "tours.obj", "torus2.obj", "toru.objj", "terse.obj", "cube.obj"};
    EXPECT_EQ(suggestion("torus.objj", known), "did you mean 'toru.objj' or 'torus.obj' or 'torus2.obj'? ");
    EXPECT_EQ(suggestion("sphere", {"cube", "plane"}), "");
}
