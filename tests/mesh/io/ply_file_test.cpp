#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "mesh/io/mesh_files.h"
#include "mesh/io/rejections.h"
#include "mesh/small_meshes.h"
#include "mesh/triangle_measures.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

const std::string ascii_header =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n";   // 9 lines
const std::string ascii_body = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

/// Returns the bytes of values of any type, in either byte order.
class Bytes {
public:
    explicit Bytes(bool big_endian) : reverse_(big_endian != (std::endian::native == std::endian::big)) {}
    template <class T> Bytes& add(T value) {
        std::string raw(sizeof(T), '\0');
        std::memcpy(raw.data(), &value, sizeof(T));
        if (reverse_) std::reverse(raw.begin(), raw.end());
        bytes_ += raw;
        return *this;
    }
    const std::string& text() const { return bytes_; }

private:
    bool reverse_;
    std::string bytes_;
};

std::string header(bool big_endian, const std::string& rest) {
    return std::string("ply\nformat binary_") + (big_endian ? "big" : "little") + "_endian 1.0\n" + rest + "end_header\n";
}

/// Returns the tetrahedron with coordinates of type X and lists of counts N and indices I.
template <class X, class N, class I>
std::string binary_tetrahedron(bool big_endian, const std::string& x, const std::string& n, const std::string& i) {
    Bytes bytes(big_endian);
    const TriangleMesh mesh = tetrahedron();
    for (int v = 0; v < 4; ++v) {
        for (int k = 0; k < 3; ++k) bytes.add(static_cast<X>(mesh.X(v, k)));
    }
    for (int t = 0; t < 4; ++t) {
        bytes.add(static_cast<N>(3));
        for (int k = 0; k < 3; ++k) bytes.add(static_cast<I>(mesh.F(t, k)));
    }
    return header(big_endian, "element vertex 4\nproperty " + x + " x\nproperty " + x + " y\nproperty " + x +
                                  " z\nelement face 4\nproperty list " + n + " " + i + " vertex_index\n") +
           bytes.text();
}

void expect_in_ply(const std::string& bytes, const std::string& warnings = "") { expect_tetrahedron(parse_ply(bytes, "m.ply"), warnings); }

}   // namespace

TEST(PlyFile, ReadsAscii) {
    expect_in_ply(ascii_header + ascii_body);
    std::string returns = ascii_header + ascii_body;
    std::replace(returns.begin(), returns.end(), '\n', '\r');
    expect_in_ply(returns);
    expect_in_ply("\xef\xbb\xbf" + ascii_header + ascii_body, "1: byte order mark ignored\n");
    expect_in_ply(replaced(ascii_header, "element", "comment end_header\nobj_info x\nelement") + ascii_body);
    expect_in_ply(ascii_header + ascii_body + "7\n", "18: text after the last element ignored\n");
    EXPECT_EQ(parse_ply(ascii_header + ascii_body, "m.ply").face_lines, (std::vector<long>{14, 15, 16, 17}));
}

TEST(PlyFile, BinaryOfEveryTypeInBothOrders) {
    for (const bool big : {false, true}) {
        expect_in_ply(binary_tetrahedron<float, std::uint8_t, std::int32_t>(big, "float", "uchar", "int"));
        expect_in_ply(binary_tetrahedron<double, std::uint32_t, std::uint32_t>(big, "float64", "uint32", "uint"));
        expect_in_ply(binary_tetrahedron<std::int16_t, std::int8_t, std::int8_t>(big, "short", "char", "int8"));
        expect_in_ply(binary_tetrahedron<std::uint8_t, std::uint16_t, std::uint16_t>(big, "uint8", "ushort", "uint16"));
        expect_in_ply(binary_tetrahedron<std::int32_t, std::int16_t, std::int16_t>(big, "int32", "int16", "short"));
    }
}

// A file of triangles alone is read in one step; a face of another size needs the general way.
TEST(PlyFile, AFaceOfAnotherSizeMayStandAnywhere) {
    for (const int quad : {0, 1, 2}) {
        Bytes bytes(false);
        for (const float x : {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) bytes.add(x);
        for (int face = 0; face < 3; ++face) {
            bytes.add(static_cast<std::uint8_t>(face == quad ? 4 : 3));
            for (int k = 0; k < (face == quad ? 4 : 3); ++k) bytes.add(k);
        }
        const LoadedMesh loaded = parse_ply(header(false,
                                                   "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                                                   "element face 3\nproperty list uchar int vertex_indices\n") +
                                                bytes.text(),
                                            "m.ply");
        ASSERT_EQ(loaded.mesh.face_count(), 4) << quad;
        for (int t = 0; t < quad; ++t) EXPECT_EQ(loaded.mesh.F.row(t), Eigen::RowVector3i(0, 1, 2)) << quad;
        EXPECT_EQ(warnings_of(loaded), "");
    }
}

TEST(PlyFile, BinaryDoublesAreExact) {
    Bytes bytes(true);
    const std::vector<double> values{0.1, -1e-300, 1e7 + 1.0 / 64, 5e-324, 1, 2, 3, 4, 5.5};
    for (const double x : values) bytes.add(x);
    bytes.add<std::uint8_t>(3).add<std::int32_t>(0).add<std::int32_t>(1).add<std::int32_t>(2);
    const LoadedMesh loaded = parse_ply(header(true,
                                               "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
                                               "element face 1\nproperty list uchar int vertex_indices\n") +
                                            bytes.text(),
                                        "m.ply");
    EXPECT_EQ(std::vector<double>(loaded.mesh.X.data(), loaded.mesh.X.data() + 9), values);
}

TEST(PlyFile, OtherElementsAndPropertiesAreSkippedWhereverTheyStand) {
    Bytes bytes(false);
    bytes.add<std::uint8_t>(2).add(1.5).add(2.5).add<std::int16_t>(7);   // one "odd"
    for (int k = 0; k < 2; ++k)
        bytes.add<std::uint8_t>(3).add<std::int32_t>(0).add<std::int32_t>(k + 1).add<std::int32_t>(k + 2).add<char>(9);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (int v = 0; v < 4; ++v)
        bytes.add(static_cast<float>(v == 3)).add(nan).add(static_cast<float>(v == 1)).add<char>(1).add(static_cast<float>(v == 2));
    const LoadedMesh loaded = parse_ply(
        header(false,
               "element odd 1\nproperty list uchar double w\nproperty short s\n"
               "element face 2\nproperty list uchar int vertex_indices\nproperty uchar flags\n"
               "element vertex 4\nproperty float z\nproperty double quality\nproperty float x\nproperty char c\nproperty float y\n") +
            bytes.text(),
        "m.ply");
    EXPECT_EQ(loaded.mesh.X, tetrahedron().X);
    EXPECT_EQ(loaded.mesh.F, (Faces(2, 3) << 0, 1, 2, 0, 2, 3).finished());
    EXPECT_EQ(warnings_of(loaded), "");
}

TEST(PlyFile, ANewlineBehindLinesThatEndInReturnsIsData) {
    Bytes bytes(true);
    for (int i = 0; i < 9; ++i) bytes.add<std::uint8_t>(static_cast<std::uint8_t>(i == 0 ? '\n' : i % 4));
    bytes.add<std::uint8_t>(3).add<std::uint8_t>(0).add<std::uint8_t>(1).add<std::uint8_t>(2);
    for (const char* end : {"\r", "\n", "\r\n"}) {
        std::string text =
            "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\n"
            "element face 1\nproperty list uchar uchar vertex_indices\nend_header\n";
        for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + std::strlen(end)))
            text.replace(at, 1, end);
        EXPECT_EQ(parse_ply(text + bytes.text(), "m.ply").mesh.X(0, 0), 10);
    }
}

TEST(PlyFile, RefusesBadHeaders) {
    const auto with = [](const std::string& from, const std::string& to) { return replaced(ascii_header, from, to) + ascii_body; };
    EXPECT_TRUE(refused("plx\n", "m.ply:1", "no 'ply'"));
    EXPECT_TRUE(refused(with("ascii 1.0", "ascii 2.0"), "m.ply:2", "version"));
    EXPECT_TRUE(refused(with("ascii", "text"), "m.ply:2", "unknown format"));
    EXPECT_TRUE(refused(with("format ascii 1.0\n", ""), "m.ply", "no format line"));
    EXPECT_TRUE(refused(with("end_header\n", ""), "m.ply:9", "unknown header line '0 0 0'"));
    EXPECT_TRUE(refused(with("float x", "quad x"), "m.ply:4", "unknown type 'quad'"));
    EXPECT_TRUE(refused(with("element vertex 4", "property int x"), "m.ply:3", "outside an element"));
    EXPECT_TRUE(refused(with("float z", "float w"), "m.ply", "no property 'z'"));
    EXPECT_TRUE(refused(with("element vertex", "element vortex"), "m.ply", "no vertex element"));
    EXPECT_TRUE(refused(with("element face", "element edge"), "m.ply", "no face element"));
    EXPECT_TRUE(refused(with("vertex_indices", "corners"), "m.ply:7", "vertex_indices"));
    EXPECT_TRUE(refused(with("list uchar", "list float"), "m.ply:8", "integer type"));
    EXPECT_TRUE(refused(with("uchar int", "uchar float"), "m.ply:8", "integer type"));
    EXPECT_TRUE(refused("ply\nformat ascii 1.0\nelement ver", "m.ply:3", "impossible count"));
    EXPECT_TRUE(refused("ply\nformat ascii 1.0\nelement vertex 4\n", "m.ply", "end_header"));
}

// Readers differ about which of two equal lines is valid.
TEST(PlyFile, RefusesRepeatedHeaderLines) {
    const auto with = [](const std::string& from, const std::string& to) { return replaced(ascii_header, from, to) + ascii_body; };
    EXPECT_TRUE(refused(with("element v", "format ascii 1.0\nelement v"), "m.ply:3", "second format"));
    EXPECT_TRUE(refused(with("element f", "format binary_big_endian 1.0\nelement f"), "m.ply:7", "second format"));
    EXPECT_TRUE(refused(with("float z\n", "float z\nproperty float x\n"), "m.ply:7", "property 'x' of element 'vertex' a second time"));
    EXPECT_TRUE(refused(with("float z\n", "float z\nproperty list uchar int z\n"), "m.ply:7", "property 'z'"));
    EXPECT_TRUE(refused(with("end_header", "property list uchar int vertex_indices\nend_header"), "m.ply:9", "a second time"));
    EXPECT_TRUE(refused(with("element f", "element vertex 4\nproperty float x\nelement f"), "m.ply:7", "element 'vertex' a second time"));
    EXPECT_TRUE(refused(with("end_header", "element face 1\nproperty list uchar int vertex_indices\nend_header"), "m.ply:9",
                        "element 'face' a second time"));
    expect_in_ply(replaced(ascii_header, "end_header", "element odd 0\nproperty float x\nend_header") + ascii_body);
}

namespace {

/// Returns a file of tristrips, one per row, over the vertices of the tetrahedron.
std::string strips_file(const std::vector<std::vector<int>>& rows, const std::string& format, const std::string& more = "") {
    const bool big = format == "binary_big_endian";
    std::string text;
    Bytes bytes(big);
    for (int v = 0; v < 4; ++v) {
        for (int k = 0; k < 3; ++k) {
            const auto x = static_cast<float>(tetrahedron().X(v, k));
            bytes.add(x);
            text += std::to_string(x) + (k < 2 ? " " : "\n");
        }
    }
    for (const std::vector<int>& row : rows) {
        bytes.add(static_cast<std::int32_t>(row.size()));
        text += std::to_string(row.size());
        for (const int v : row) {
            bytes.add(static_cast<std::int32_t>(v));
            text += " " + std::to_string(v);
        }
        text += "\n";
    }
    return "ply\nformat " + format + " 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n" + more +
           "element tristrips " + std::to_string(rows.size()) + "\nproperty list int int vertex_indices\nend_header\n" +
           (format == "ascii" ? text : bytes.text());
}

const std::vector<std::string> formats{"ascii", "binary_little_endian", "binary_big_endian"};

Faces strip_faces(const std::vector<std::vector<int>>& rows, const std::string& format) {
    return parse_ply(strips_file(rows, format), "m.ply").mesh.F;
}

}   // namespace

// Every second triangle is turned, −1 begins a new strip; the tetrahedron is one strip.
TEST(PlyFile, ReadsTristrips) {
    const Faces whole = (Faces(4, 3) << 0, 1, 2, 2, 1, 3, 2, 3, 0, 0, 3, 1).finished();
    for (const std::string& format : formats) {
        EXPECT_EQ(strip_faces({{0, 1, 2, 3, 0, 1, -1}}, format), whole) << format;
        EXPECT_EQ(strip_faces({{0, 1, 2, 3, 0, 1}}, format), whole) << format;
        EXPECT_EQ(strip_faces({{0, 1, 2, 3, -1, 2, 3, 0, 1}}, format), whole) << format << ": the turn begins anew";
        EXPECT_EQ(strip_faces({{-1, 0, 1, 2, 3, -1, -1}, {}, {2, 3, 0, 1}}, format), whole) << format << ": empty strips and rows";
        EXPECT_EQ(warnings_of(parse_ply(strips_file({{0, 1, 2, 3, 0, 1, -1}}, format), "m.ply")), "");
    }
    EXPECT_EQ(parse_ply(strips_file({{0, 1, 2, 3}}, "ascii"), "m.ply").face_lines, (std::vector<long>{14, 14}));
}

TEST(PlyFile, TristripsAreCheckedAsFacesAre) {
    for (const std::string& format : formats) {
        const std::string line = format == "ascii" ? "14" : "0";
        EXPECT_EQ(warnings_of(parse_ply(strips_file({{0, 1, -1, 2, -1, 0, 2, 1}}, format), "m.ply")),
                  line + ": 2 faces with fewer than 3 vertices ignored\n");
        const std::string where = format == "ascii" ? "m.ply:14" : "m.ply";
        EXPECT_TRUE(refused(strips_file({{0, 1, 4}}, format), where, "tristrips 0: index 4 out of range (4 vertices)"));
        EXPECT_TRUE(refused(strips_file({{0, 1, 2}, {0, 1, 2, -2}}, format), format == "ascii" ? "m.ply:15" : "m.ply",
                            "tristrips 1: index -2 out of range"));
        EXPECT_TRUE(refused(strips_file({{0, 1, -1}}, format), "m.ply", "no triangles"));
        const std::string whole = strips_file({{0, 1, 2, 3, 0, 1, -1}}, format);
        for (std::size_t size = 1; size + 2 < whole.size(); ++size) EXPECT_NE(refusal(whole.substr(0, size), "m.ply"), "accepted") << size;
        EXPECT_TRUE(refused(replaced(whole, "tristrips 1", "tristrips 2000000000"), "m.ply:7", "impossible count"));
        EXPECT_TRUE(refused(replaced(whole, "vertex_indices", "corners"), "m.ply:7", "tristrips has no property 'vertex_indices'"));
    }
    EXPECT_TRUE(refused(replaced(strips_file({{0, 1, 2}}, "ascii"), "3 0 1 2", "2000000000 0 1 2"), "m.ply:14", "too few"));
    EXPECT_TRUE(refused(replaced(strips_file({{0, 1, 2}}, "ascii"), "3 0 1 2", "-3 0 1 2"), "m.ply:14", "list of -3"));
}

// They usually describe the same surface again.
TEST(PlyFile, TristripsBesideFacesAreIgnored) {
    const std::string header =
        replaced(ascii_header, "end_header", "element tristrips 1\nproperty list int int vertex_indices\nend_header");
    expect_in_ply(header + ascii_body + "4 0 1 2 3\n", "9: tristrips beside faces ignored\n");
    const std::string none = strips_file({{0, 1, 2, 3, 0, 1}}, "ascii", "element face 0\nproperty list uchar int vertex_indices\n");
    EXPECT_EQ(parse_ply(none, "m.ply").mesh.F.rows(), 4);
}

TEST(PlyFile, RefusesImpossibleCountsBeforeAllocating) {
    for (const char* count : {"-1", "2147483648", "9223372036854775808", "2147483647", "1000", "x"}) {
        EXPECT_TRUE(refused(replaced(ascii_header, "vertex 4", std::string("vertex ") + count) + ascii_body, "m.ply:3", "impossible count"))
            << count;
        EXPECT_TRUE(refused(replaced(ascii_header, "face 4", std::string("face ") + count) + ascii_body, "m.ply:7", "impossible count"))
            << count;
    }
    const std::string empty_rows = replaced(ascii_header, "element face", "element nothing 2000000000\nelement face");
    EXPECT_TRUE(refused(empty_rows + ascii_body, "m.ply:7", "no properties"));
}

TEST(PlyFile, RefusesEveryTruncation) {
    const std::string whole = binary_tetrahedron<float, std::uint8_t, std::int32_t>(true, "float", "uchar", "int");
    for (std::size_t size = 1; size < whole.size(); ++size) EXPECT_NE(refusal(whole.substr(0, size), "m.ply"), "accepted") << size;
    EXPECT_NE(refusal(ascii_header + ascii_body.substr(0, ascii_body.size() - 3), "m.ply"), "accepted");
}

TEST(PlyFile, RefusesBadValues) {
    EXPECT_TRUE(refused(ascii_header + replaced(ascii_body, "1 0 0", "1,0 0 0"), "m.ply:11", "'1,0'"));
    EXPECT_TRUE(refused(ascii_header + replaced(ascii_body, "1 0 0", "1 0 0 0"), "m.ply:11", "more values"));
    EXPECT_TRUE(refused(ascii_header + replaced(ascii_body, "1 0 0", "1 0"), "m.ply:11", "too few"));
    EXPECT_TRUE(refused(ascii_header + replaced(ascii_body, "3 1 2 3", "3 1 2 4"), "m.ply:17", "index 4 out of range (4 vertices)"));
    EXPECT_TRUE(refused(ascii_header + replaced(ascii_body, "3 1 2 3", "3 1 2 -1"), "m.ply:17", "index -1"));
    EXPECT_TRUE(refused(ascii_header + replaced(ascii_body, "3 1 2 3", "-3 1 2 3"), "m.ply:17", "list of -3"));
    EXPECT_TRUE(refused(ascii_header + replaced(ascii_body, "3 1 2 3", "3 1 2 3.0"), "m.ply:17", "'3.0'"));
    const std::string good = binary_tetrahedron<float, std::uint8_t, std::int32_t>(false, "float", "uchar", "int");
    const std::size_t body = good.find("end_header\n") + 11;
    std::string nan = good;
    nan.replace(body, 4, Bytes(false).add(std::nanf("")).text());
    EXPECT_TRUE(refused(nan, "m.ply", "vertex 0: x is nan"));
    std::string index = good;
    index.replace(good.size() - 4, 4, Bytes(false).add<std::int32_t>(-1).text());
    EXPECT_TRUE(refused(index, "m.ply", "face 3: index -1"));
    EXPECT_TRUE(refused(replaced(good, "little", "big"), "m.ply", ""));
}

// ---- other values of a vertex ---------------------------------------------------------------------------------------------

namespace {

const std::string with_colors =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty uchar red\nproperty float x\nproperty float y\nproperty float z\n"
    "property float quality\nproperty list uchar int ring\nproperty float ny\nproperty int id\nproperty double deep\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0 0 0.1 1 7 0 -1 1e-310\n255 1 0 0 nan 0 9 2147483647 0.1\n7 0 1 0 -inf 2 1 2 0 -2147483648 +3\n8 0 0 1 5 0 0 4 -0\n"
    "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

/// Returns the bits, so that NaN equals NaN.
void expect_same_columns(const std::vector<VertexColumn>& a, const std::vector<VertexColumn>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].name, b[i].name);
        EXPECT_EQ(a[i].type, b[i].type);
        EXPECT_EQ(std::memcmp(a[i].values.data(), b[i].values.data(), sizeof(double) * 4), 0) << a[i].name;
    }
}

}   // namespace

TEST(PlyColumns, AreReadOnRequest) {
    const LoadedMesh read = parse_ply(with_colors, "m.ply", Keep::attributes);
    expect_tetrahedron(read, "0: properties that are not kept (ring)\n");
    const std::vector<VertexColumn>& columns = read.attributes.columns;
    ASSERT_EQ(columns.size(), 5U) << "of numbers, not of lists";
    EXPECT_EQ(columns[0].values, (Vector(4) << 0, 255, 7, 8).finished());
    EXPECT_EQ(columns[1].name, "quality");
    EXPECT_TRUE(std::isnan(columns[1].values[1]));
    EXPECT_EQ(columns[3].values, (Vector(4) << -1, 2147483647, -2147483648.0, 4).finished());
    EXPECT_EQ(columns[4].values, (Vector(4) << 1e-310, 0.1, 3, 0).finished());
    EXPECT_TRUE(parse_ply(with_colors, "m.ply").attributes.columns.empty());
}

TEST(PlyColumns, ComeBackBitForBit) {
    const LoadedMesh read = parse_ply(with_colors, "m.ply", Keep::attributes);
    std::vector<VertexColumn> columns = read.attributes.columns;
    for (double& value : columns[1].values) value = static_cast<float>(value);           // 0.1 was no float
    columns[2].values = vertex_normals(read.mesh).col(1).cast<float>().cast<double>();   // ny: that of the mesh
    const std::string bytes = encode_mesh(read.mesh, "m.ply", read.attributes);
    const LoadedMesh again = parse_ply(bytes, "m.ply", Keep::attributes);
    expect_same_columns(again.attributes.columns, columns);
    EXPECT_EQ(encode_mesh(again.mesh, "m.ply", again.attributes), bytes);
    EXPECT_EQ(again.mesh.X, read.mesh.X);
}

TEST(PlyColumns, NamesAreMadeValidForHeaders) {
    const Vector values = Vector::LinSpaced(4, 0, 1);
    const std::string bytes =
        encode_mesh(tetrahedron(), "m.ply", {.columns = {{"x", values}, {"a b", values}, {"a_b", values}, {"", values}}});
    std::string names;
    for (const VertexColumn& column : parse_ply(bytes, "m.ply", Keep::attributes).attributes.columns) names += column.name + " ";
    EXPECT_EQ(names, "x_ a_b a_b_ _ ");
    expect_tetrahedron(parse_ply(bytes, "m.ply"));
}

TEST(PlyColumns, ValuesThatDoNotFitTheirTypeAreRefusedWithTheirLine) {
    for (const auto& [from, to] : {std::pair{"255 1 0 0", "256 1 0 0"},
                                   {"255 1 0 0", "-1 1 0 0"},
                                   {"255 1 0 0", "1.5 1 0 0"},
                                   {"nan", "five"},
                                   {"nan", "1e400"},
                                   {"2147483647", "2147483648"}}) {
        const std::string text = replaced(with_colors, from, to);
        EXPECT_THROW(parse_ply(text, "m.ply", Keep::attributes), InputError) << to;
        try {
            parse_ply(text, "m.ply", Keep::attributes);
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("m.ply:17: '"), std::string::npos) << error.what();
        }
    }
}
