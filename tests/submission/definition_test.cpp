#include "submission/source_listing.h"

#include <gtest/gtest.h>

#include <string>

namespace meshfolio::submission {
namespace {

/// Text in which calls, declarations and comments come before each definition.
const std::string cpp_text = R"text(#include "area.h"
// double area(double r) { in a comment }
/* double area(double r) {
} */
#define MAKE(name) double area(double r) { \
    return name; }
namespace shapes {

double area(double r);
class Disk;
const char* const words = "double area(double r) {";
const char* const more = R"x(
    double area(double r) {
)x";
const double unit = area({1'000}) + Disk{}.area();
struct Wrapper {
    double area(double r) { return r; }
};

namespace {
double twice(double r) {
    return 2 * area(r);
}
}   // namespace

template <class Number, std::enable_if_t<(sizeof(Number) > 4), int> = 0>
std::vector<std::function<double(double)>>
area(const Number& r, const Options& options = {}) {
    return {};
}

double area(double r) { return r; }

enum class Kind { one, two };
class Disk final : public Wrapper, Shape<int> {
public:
    Disk(double r);
};
struct Disk::Part {
    int x = 0;
};
Disk::Disk(double r) : Wrapper{r}, other_(area(r)), third_{1} {
    area(r);
}
double Disk::size() const try {
    return 1;
} catch (...) { return 0; }
inline constexpr bool operator==(const Disk& a, const Disk& b) { return true; }
}   // namespace shapes
)text";

/// Returns the text of the line that defines a name.
std::string found(const std::string& name) {
    long line = definition_line(cpp_text, name);
    if (line == 0) return "";
    std::size_t begin = 0;
    for (; line > 1; --line) begin = cpp_text.find('\n', begin) + 1;
    return cpp_text.substr(begin, cpp_text.find('\n', begin) - begin);
}

}   // namespace

TEST(Definition, IsNoCallDeclarationMemberOrComment) {
    EXPECT_EQ(found("area"), "area(const Number& r, const Options& options = {}) {") << "the line with the name, not that of its type";
    EXPECT_EQ(found("twice"), "double twice(double r) {");
}

TEST(Definition, OfATypeOrMemberIsFound) {
    EXPECT_EQ(found("Kind"), "enum class Kind { one, two };");
    EXPECT_EQ(found("Disk"), "class Disk final : public Wrapper, Shape<int> {") << "not its declaration, not its constructor";
    EXPECT_EQ(found("Disk::Part"), "struct Disk::Part {");
    EXPECT_EQ(found("Disk::Disk"), "Disk::Disk(double r) : Wrapper{r}, other_(area(r)), third_{1} {");
    EXPECT_EQ(found("size"), "double Disk::size() const try {") << "no function has this name alone";
}

TEST(Definition, OfAnUndefinedNameIsNotFound) {
    for (const char* name : {"", "volume", "words", "unit", "are", "rea", "shapes", "other_", "third_", "MAKE", "if", "Wrapper::area"})
        EXPECT_EQ(definition_line(cpp_text, name), 0) << name;
    EXPECT_EQ(definition_line("double area(double r);\ndouble s = area(2);\n", "area"), 0);
    EXPECT_EQ(definition_line("", "area"), 0);
}

TEST(Definition, BrokenTextEndsTheSearch) {
    for (const std::string broken :
         {"int area(", "int area() {", "/* ", "\"", "R\"x(", "#define \\", "template <", "}}} ) (", "R\"", "'\\"})
        EXPECT_GE(definition_line(broken, "area"), 0) << broken;
    EXPECT_EQ(definition_line("int area() {", "area"), 1);
}

}   // namespace meshfolio::submission
