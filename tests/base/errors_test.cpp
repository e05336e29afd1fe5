#include "base/errors.h"

#include <gtest/gtest.h>

using namespace meshfolio;

TEST(Errors, TheMessageIsOneLineWithFileLineProblemAndRemedy) {
    EXPECT_STREQ(InputError({"a.obj", 7}, "bad face corner '2//'", "write i, i/j or i/j/k").what(),
                 "a.obj:7: bad face corner '2//'; write i, i/j or i/j/k");
    EXPECT_STREQ(InputError({"a.obj"}, "file is empty").what(), "a.obj: file is empty");
    EXPECT_EQ(OutputError("/full", "cannot write").exit_code(), ExitCode::output);
}

TEST(Errors, NamesOfFilesCannotSendTerminalEscapes) {
    EXPECT_STREQ(InputError({"\x1b[31m\n.obj"}, "x").what(), "\\x1b[31m\\x0a.obj: x");
    EXPECT_EQ(printable("gr\xc3\xbc\xc3\x9f"), "gr\xc3\xbc\xc3\x9f");
    EXPECT_EQ(printable("\xe2\x80\xae"
                        "abc"),
              "\\xe2\\x80\\xae"
              "abc");                                          // right-to-left override
    EXPECT_EQ(printable("\xc0\xaf\xff"), "\\xc0\\xaf\\xff");   // overlong, not UTF-8
    EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");   // a lone surrogate
}
