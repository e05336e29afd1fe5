// VTK's PolyData in all encodings that VTK and ParaView write.
#include <gtest/gtest.h>
#include <libdeflate.h>

#include <cstdint>

#include "damaged_bytes.h"
#include "mesh/io/append_bytes.h"
#include "mesh/io/mesh_files.h"
#include "mesh/io/rejections.h"
#include "mesh/small_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

std::string base64_of(const std::string& bytes) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = i; k < i + 3; ++k) bits = bits << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
    }
    return text;
}

std::string zlib_of(const std::string& bytes) {
    libdeflate_compressor* const compressor = libdeflate_alloc_compressor(6);
    std::string packed(libdeflate_zlib_compress_bound(compressor, bytes.size()), '\0');
    packed.resize(libdeflate_zlib_compress(compressor, bytes.data(), bytes.size(), packed.data(), packed.size()));
    libdeflate_free_compressor(compressor);
    return packed;
}

/// The encoding of arrays in a file.
struct Form {
    bool appended, text, packed, long_header, big_endian;
    std::size_t block = 40;       // bytes that are packed together
    int parts = packed ? 2 : 1;   // of text, encoded apart from each other: all; sizes and data; the first size, the others and data
};

class Writer {
public:
    explicit Writer(const Form& form) : form_(form) {}

    template <class T> std::string array(const std::string& type, const std::string& name, int components, const std::vector<T>& values) {
        std::string raw;
        for (const T value : values) append(raw, value, form_.big_endian);
        const std::string data = encoded(raw);
        std::string element =
            "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" + std::to_string(components) + "\" ";
        if (!form_.appended) return element + "format=\"binary\">\n" + data + "\n</DataArray>\n";
        element += "format=\"appended\" offset=\"" + std::to_string(appended_.size()) + "\"/>\n";
        appended_ += data;
        return element;
    }

    std::string file(const std::string& pieces) const {
        return std::string("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"") +
               (form_.big_endian ? "Big" : "Little") + "Endian\"" + (form_.long_header ? " header_type=\"UInt64\"" : "") +
               (form_.packed ? " compressor=\"vtkZLibDataCompressor\"" : "") + "><PolyData>\n" + pieces + "</PolyData>\n" +
               (form_.appended
                    ? std::string("<AppendedData encoding=\"") + (form_.text ? "base64" : "raw") + "\">\n _" + appended_ + "</AppendedData>"
                    : "") +
               "</VTKFile>\n";
    }

private:
    void put(std::string& bytes, std::size_t size) const {
        if (form_.long_header) return append(bytes, std::uint64_t{size}, form_.big_endian);
        append(bytes, static_cast<std::uint32_t>(size), form_.big_endian);
    }

    std::string encoded(const std::string& raw) const {
        const auto written = [&](const std::string& bytes) { return form_.text ? base64_of(bytes) : bytes; };
        std::string header, data;
        if (!form_.packed) {
            put(header, raw.size());
            return form_.parts == 1 ? written(header + raw) : written(header) + "\n" + written(raw);
        }
        const std::size_t blocks = (raw.size() + form_.block - 1) / form_.block;
        for (const std::size_t number : {blocks, form_.block, raw.size() % form_.block}) put(header, number);
        for (std::size_t b = 0; b < blocks; ++b) {
            const std::string packed = zlib_of(raw.substr(b * form_.block, form_.block));
            put(header, packed.size());
            data += packed;
        }
        const std::size_t first = form_.long_header ? 8 : 4;
        if (form_.parts == 3) return written(header.substr(0, first)) + written(header.substr(first)) + written(data);
        return form_.parts == 1 ? written(header + data) : written(header) + written(data);
    }

    Form form_;
    std::string appended_;
};

/// Returns the tetrahedron with a colour, a float and a normal at each vertex.
std::string vtp(const Form& form) {
    Writer writer(form);
    std::string piece =
        "<Piece NumberOfPoints=\"4\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"4\"><PointData>";
    piece += writer.array<std::uint8_t>("UInt8", "Colours", 3, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 255});
    piece += writer.array<float>("Float32", "quality", 1, {0.5F, -1, 2, 1e30F});
    piece += writer.array<float>("Float32", "Normals", 3, std::vector<float>(12, 1));
    piece += writer.array<std::int16_t>("Int16", "pair", 2, {0, 1, 2, 3, 4, 5, 6, -7});
    const TriangleMesh mesh = tetrahedron();
    piece +=
        "</PointData><Points>" + writer.array<double>("Float64", "Points", 3, {mesh.X.data(), mesh.X.data() + 12}) + "</Points><Polys>";
    piece += writer.array<std::int64_t>("Int64", "connectivity", 1, {mesh.F.data(), mesh.F.data() + 12});
    piece += writer.array<std::int64_t>("Int64", "offsets", 1, {3, 6, 9, 12}) + "</Polys></Piece>\n";
    return writer.file(piece);
}

std::vector<Form> all_forms() {
    std::vector<Form> forms;
    for (int bits = 0; bits < 32; ++bits) {
        const Form form{(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0, (bits & 16) != 0};
        if (form.appended || form.text) forms.push_back(form);   // raw bytes stand behind the XML only
        for (int parts = 1; form.text && parts <= 3; ++parts) {
            forms.push_back(form);
            forms.back().parts = parts;
        }
    }
    return forms;
}

std::string names_of(const std::vector<VertexColumn>& columns) {
    std::string names;
    for (const VertexColumn& column : columns) names += column.name + " ";
    return names;
}

const std::string ascii =
    "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\">\n<PolyData><Piece NumberOfPoints=\"4\" NumberOfLines=\"1\">\n"
    "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0\n 0 1 0 0 0 1</DataArray></Points>\n"
    "<Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 2 1  0 1 3  0 3 2  1 2 3</DataArray>\n"
    "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3 6 9 12</DataArray></Polys>\n</Piece></PolyData></VTKFile>\n";

}   // namespace

TEST(Vtp, EveryFormReadsAlike) {
    for (const Form& form : all_forms()) {
        const LoadedMesh read = parse_mesh(vtp(form), "m.vtp", Keep::attributes);
        const std::string which = std::to_string(form.appended) + std::to_string(form.text) + std::to_string(form.packed) +
                                  std::to_string(form.long_header) + std::to_string(form.big_endian) + std::to_string(form.parts);
        expect_tetrahedron(read, "", which);
        const std::vector<VertexColumn>& columns = read.attributes.columns;
        ASSERT_EQ(names_of(columns), "red green blue quality nx ny nz pair_0 pair_1 ") << which;
        EXPECT_EQ(columns[2].values, (Vector(4) << 3, 6, 9, 255).finished()) << which;
        EXPECT_EQ(columns[3].values, (Vector(4) << 0.5, -1, 2, 1e30F).finished()) << which;
        EXPECT_EQ(columns[8].values, (Vector(4) << 1, 3, 5, -7).finished()) << which;
        EXPECT_EQ(columns[8].type, ScalarType::int16);
    }
    expect_tetrahedron(parse_mesh(ascii, "m.vtp"), "0: points or lines ignored\n");
    expect_tetrahedron(parse_mesh(ascii, standard_input), "0: points or lines ignored\n");
}

TEST(Vtp, WrittenFilesReadBackBitForBit) {
    TriangleMesh mesh = torus(9, 7);
    mesh.X.row(0) << 0.1, -0.0, 5e-324;
    mesh.X.row(1) << 1e100, -1e100, 1. / 3;
    const int n = mesh.vertex_count();
    const auto bytes_up_to = [&](double most) { return Vector(Vector::LinSpaced(n, 0, most).array().floor()); };
    std::vector<VertexColumn> columns{{"a & \"b\" <c>", Vector::Random(n)}};
    for (const char* channel : {"red", "green", "blue", "alpha"}) columns.push_back({channel, bytes_up_to(255), ScalarType::uint8});
    columns.push_back({"id", -bytes_up_to(2e9), ScalarType::int32});
    columns.push_back({"hole", Vector::Constant(n, std::nan("")), ScalarType::float32});
    const std::string bytes = encode_mesh(mesh, "m.vtp", {.columns = columns});
    const LoadedMesh read = parse_mesh(bytes, "m.vtp", Keep::attributes);
    EXPECT_EQ(std::memcmp(read.mesh.X.data(), mesh.X.data(), sizeof(double) * 3 * static_cast<std::size_t>(n)), 0);
    EXPECT_EQ(read.mesh.F, mesh.F);
    ASSERT_EQ(names_of(read.attributes.columns), names_of(columns));
    for (std::size_t i = 0; i + 1 < columns.size(); ++i) {
        EXPECT_EQ(read.attributes.columns[i].values, columns[i].values);
        EXPECT_EQ(read.attributes.columns[i].type, columns[i].type);
    }
    EXPECT_TRUE(read.attributes.columns.back().values.array().isNaN().all());
    EXPECT_EQ(encode_mesh(read.mesh, "m.vtp", read.attributes), bytes);
}

TEST(Vtp, AsciiMayHoldNanAndInfinities) {
    const auto with_values = [](const std::string& type, const std::string& words) {
        return replaced(
            ascii, "<Points>",
            "<PointData><DataArray type=\"" + type + "\" Name=\"a\" format=\"ascii\">" + words + "</DataArray></PointData><Points>");
    };
    const Vector values =
        parse_mesh(with_values("Float64", "NaN inf -Infinity -nan"), "m.vtp", Keep::attributes).attributes.columns[0].values;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(std::isnan(values[0]) && values[1] == infinity && values[2] == -infinity && std::isnan(values[3])) << values;
    for (const std::string word : {"NaN", "inf"}) {
        EXPECT_TRUE(refused(replaced(ascii, "0 0 0 1", "0 0 " + word + " 1"), "m.vtp", "a coordinate is not finite"));
        EXPECT_THROW(parse_mesh(with_values("Int32", "1 2 3 " + word), "m.vtp", Keep::attributes), InputError);
    }
    for (const std::string word : {"nano", "1e999", "0x1p3", "infinit"})
        EXPECT_THROW(parse_mesh(with_values("Float32", "1 2 3 " + word), "m.vtp", Keep::attributes), InputError) << word;
}

TEST(Vtp, ArraysStayArraysUnderTheirNames) {
    Writer writer({true, false, false, true, false});
    std::string arrays = writer.array<float>("Float32", "Velocity", 3, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
    for (const std::string name : {"Colors", "Tint"})
        arrays += writer.array<std::uint8_t>("UInt8", name, 3, std::vector<std::uint8_t>(12, 7));
    arrays += writer.array<std::int64_t>("Int64", "id", 1, {1, -2, 2000000000, 4}) +
              writer.array<std::int64_t>("Int64", "far", 1, {1, 2, 3, 1LL << 40});
    arrays += writer.array<double>("Float64", "stress", 2, std::vector<double>(8, 2));
    const TriangleMesh mesh = tetrahedron();
    std::string piece = "<Piece NumberOfPoints=\"4\"><PointData>" + arrays + "</PointData><CellData>";
    piece += writer.array<float>("Float32", "of faces", 1, {1, 2, 3, 4}) + "</CellData><Points>";
    piece += writer.array<double>("Float64", "Points", 3, {mesh.X.data(), mesh.X.data() + 12}) + "</Points><Polys>";
    piece += writer.array<std::int64_t>("Int64", "connectivity", 1, {mesh.F.data(), mesh.F.data() + 12});
    piece += writer.array<std::int64_t>("Int64", "offsets", 1, {3, 6, 9, 12}) + "</Polys></Piece>\n";
    const LoadedMesh read = parse_mesh(writer.file(piece), "m.vtp", Keep::attributes);
    const std::string names = "Velocity_x Velocity_y Velocity_z red green blue Tint_x Tint_y Tint_z id far stress_0 stress_1 ";
    EXPECT_EQ(names_of(read.attributes.columns), names);
    EXPECT_EQ(warnings_of(read), "0: arrays that are not kept (of faces)\n");
    const std::string bytes = encode_mesh(read.mesh, "m.vtp", read.attributes);
    for (const char* array : {"Name=\"Velocity\" NumberOfComponents=\"3\"", "Name=\"Colors\" NumberOfComponents=\"3\"",
                              "Name=\"Tint\" NumberOfComponents=\"3\"", "Name=\"stress\" NumberOfComponents=\"2\""})
        EXPECT_NE(bytes.find(array), std::string::npos) << array;
    const LoadedMesh again = parse_mesh(bytes, "m.vtp", Keep::attributes);
    EXPECT_EQ(names_of(again.attributes.columns), names);
    EXPECT_EQ(read.attributes.columns[9].type, ScalarType::int32);
    EXPECT_EQ(read.attributes.columns[10].type, ScalarType::float64) << "no other format has longer ones";
    for (std::size_t i = 0; i < 13; ++i) EXPECT_EQ(again.attributes.columns[i].values, read.attributes.columns[i].values) << i;
    const LoadedMesh through = parse_mesh(encode_mesh(read.mesh, "m.glb", read.attributes), "m.glb", Keep::attributes);
    EXPECT_NE(encode_mesh(through.mesh, "m.vtp", through.attributes).find("Name=\"Velocity\" NumberOfComponents=\"3\""), std::string::npos);
}

TEST(Vtp, StripsAndPieces) {
    const std::string strip = replaced(replaced(ascii, "0 2 1  0 1 3  0 3 2  1 2 3", "0 1 2 3"), "3 6 9 12", "4");
    std::string strips = replaced(replaced(strip, "<Polys>", "<Strips>"), "</Polys>", "</Strips>");
    EXPECT_EQ(parse_mesh(strips, "m.vtp").mesh.F, mesh_of({}, {{0, 1, 2}, {2, 1, 3}}).F);
    EXPECT_EQ(parse_mesh(strip, "m.vtp").mesh.face_count(), 2) << "a polygon of four corners";
    const std::size_t begin = ascii.find("<Piece"), end = ascii.find("</PolyData>");
    const std::string twice = ascii.substr(0, end) + ascii.substr(begin, end - begin) + ascii.substr(end);
    EXPECT_EQ(parse_mesh(twice, "m.vtp").mesh.F, joined(tetrahedron(), tetrahedron()).F);
}

// pyvista #2411. Bits of vtkDataSetAttributes: a duplicate is 1, a refined cell 8, a hidden cell 32, a hidden point 2.
TEST(Vtp, GhostAndHiddenCellsAreLeftOut) {
    const auto with = [](const std::string& data, const std::string& array, const std::string& values) {
        return replaced(ascii, "<Points>",
                        "<" + data + "><DataArray type=\"UInt8\" Name=\"" + array + "\" format=\"ascii\">" + values + "</DataArray></" +
                            data + "><Points>");
    };
    const auto faces = [](const std::string& text) { return parse_mesh(text, "m.vtp", Keep::attributes).mesh.face_count(); };
    for (int bits = 0; bits < 256; ++bits) {   // the first cell is the line
        const std::string flags = std::to_string(bits);
        EXPECT_EQ(faces(with("CellData", "vtkGhostType", "0 " + flags + " 0 " + flags + " 0")), (bits & 41) != 0 ? 2 : 4) << bits;
        EXPECT_EQ(faces(with("CellData", "vtkGhostLevels", "1 0 " + flags + " 0 0")), bits != 0 ? 3 : 4) << bits;
        EXPECT_EQ(faces(with("PointData", "vtkGhostType", "0 " + flags + " 0 0")), (bits & 2) != 0 ? 1 : 4) << bits;
    }
    const LoadedMesh some = parse_mesh(with("CellData", "vtkGhostType", "0 0 32 1 0"), "m.vtp", Keep::attributes);
    EXPECT_EQ(some.mesh.F, mesh_of({}, {{0, 2, 1}, {1, 2, 3}}).F);
    EXPECT_EQ(some.mesh.X, tetrahedron().X) << "vertices keep their order";
    EXPECT_EQ(warnings_of(some), "0: points or lines ignored\n0: 2 ghost or hidden cells left out\n");
    EXPECT_EQ(faces(with("PointData", "vtkGhostType", "1 1 1 0")), 3) << "a cell of duplicate points alone";
    const std::string owned = replaced(with("PointData", "vtkGhostType", "1 1 1 1"), "<Points>",
                                       "<CellData><DataArray type=\"UInt8\" Name=\"vtkGhostType\" format=\"ascii\">0 0 0 0 0</DataArray>"
                                       "</CellData><Points>");
    EXPECT_EQ(faces(owned), 4) << "cells say themselves whose they are";
    EXPECT_TRUE(refused(with("CellData", "vtkGhostType", "0 0 0 0"), "m.vtp", "not one entry a cell"));
    EXPECT_TRUE(refused(with("PointData", "vtkGhostType", "0 0 0"), "m.vtp", "not one entry a point"));
    EXPECT_TRUE(refused(with("CellData", "vtkGhostType", "0 1 1 8 32"), "m.vtp", "no triangles"));
}

TEST(Vtp, GhostStripsAreLeftOutWhole) {
    const std::string strip = replaced(replaced(ascii, "0 2 1  0 1 3  0 3 2  1 2 3", "0 1 2 3 0 1 2"), "3 6 9 12", "4 7");
    const std::string strips = replaced(replaced(strip, "<Polys>", "<Strips>"), "</Polys>", "</Strips>");
    const std::string ghost =
        replaced(strips, "<Points>",
                 "<CellData><DataArray type=\"UInt8\" Name=\"vtkGhostType\" format=\"ascii\">0 1 0</DataArray></CellData><Points>");
    EXPECT_EQ(parse_mesh(ghost, "m.vtp").mesh.F, mesh_of({}, {{0, 1, 2}}).F);
}

TEST(Vtp, ManyArraysTakeNoMoreThanMoments) {
    std::string empty =
        "<Piece NumberOfPoints=\"0\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\"/></Points><PointData>";
    std::string shared;
    for (int i = 0; i < 800; ++i) {
        const std::string array = "<DataArray type=\"Int8\" Name=\"" + std::to_string(i) + "\" NumberOfComponents=\"1000\" format=\"";
        empty += array + "ascii\"/>";
        shared += array + "appended\" offset=\"0\"/>";
    }
    EXPECT_TRUE(
        parse_mesh(replaced(ascii, "<Piece", empty + "</PointData></Piece><Piece"), "m.vtp", Keep::attributes).attributes.columns.empty());
    const std::string zeros = std::string("\xa0\x0f\0\0", 4) + std::string(4000, '\0');
    const std::string many = replaced(replaced(ascii, "<Points>", "<PointData>" + shared + "</PointData><Points>"), "</VTKFile>",
                                      "<AppendedData encoding=\"raw\">_" + zeros + "</AppendedData></VTKFile>");
    try {
        parse_mesh(many, "m.vtp", Keep::attributes);
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("more than 10000 numbers a point"), std::string::npos) << error.what();
    }
    EXPECT_EQ(parse_mesh(many, "m.vtp").mesh.face_count(), 4);
}

TEST(Vtp, ColoursOfAnyTypeKeepTheirNames) {
    for (const ScalarType type : {ScalarType::uint8, ScalarType::uint16, ScalarType::float32}) {
        for (const std::size_t channels : {3U, 4U}) {
            std::vector<VertexColumn> columns{{"grey", Vector::LinSpaced(4, 0, 3), ScalarType::uint8}};
            for (std::size_t i = 0; i < channels; ++i)
                columns.push_back({std::array{"red", "green", "blue", "alpha"}[i], Vector::Constant(4, double(i % 2)), type});
            for (const char* file : {"m.vtp", "m.ply"}) {
                const LoadedMesh read = parse_mesh(encode_mesh(tetrahedron(), file, {.columns = columns}), file, Keep::attributes);
                ASSERT_EQ(names_of(read.attributes.columns), names_of(columns)) << file;
                for (std::size_t i = 0; i < columns.size(); ++i) {
                    EXPECT_EQ(read.attributes.columns[i].values, columns[i].values);
                    EXPECT_EQ(read.attributes.columns[i].type, columns[i].type);
                }
            }
        }
    }
}

TEST(Vtp, RefusalsNameTheProblem) {
    EXPECT_TRUE(refused(replaced(ascii, "PolyData><Piece", "UnstructuredGrid><Piece"), "m.vtp", "no XML of VTK"));
    std::string grid = ascii;
    for (int i = 0; i < 3; ++i) grid = replaced(grid, "PolyData", "StructuredGrid");
    EXPECT_TRUE(refused(grid, "m.vtp", "holds 'StructuredGrid', not PolyData"));
    EXPECT_TRUE(refused(replaced(ascii, "byte_order", "compressor=\"vtkLZ4DataCompressor\" byte_order"), "m.vtp",
                        "packed by 'vtkLZ4DataCompressor'"));
    EXPECT_TRUE(refused(replaced(ascii, "1 2 3<", "1 2 4<"), "m.vtp", "index 4 out of range (4 points)"));
    EXPECT_TRUE(refused(replaced(ascii, "1 2 3<", "1 2 -3<"), "m.vtp", "index -3 out of range"));
    EXPECT_TRUE(refused(replaced(ascii, "1 2 3<", "1 2 1.5<"), "m.vtp", "'1.5' is no number of its type"));
    EXPECT_TRUE(refused(replaced(ascii, "3 6 9 12", "3 6 9 13"), "m.vtp", "offsets of cells do not rise"));
    EXPECT_TRUE(refused(replaced(ascii, "3 6 9 12", "3 6 5 12"), "m.vtp", "offsets of cells do not rise"));
    EXPECT_TRUE(refused(replaced(ascii, "0 0 0 1", "0 0 1e101 1"), "m.vtp", "beyond 1e100"));
    EXPECT_TRUE(refused(replaced(ascii, "0 0 0 1", "0 0 x 1"), "m.vtp", "'x' is no number of its type"));
    EXPECT_TRUE(refused(replaced(ascii, "3 6 9 12", "3 6 9 1e10"), "m.vtp", "'1e10' is no number of its type"));
    EXPECT_TRUE(refused(replaced(ascii, "3 6 9 12", "3 6 9 nan"), "m.vtp", "'nan' is no number of its type"));
    EXPECT_TRUE(refused(replaced(ascii, "NumberOfPoints=\"4\"", "NumberOfPoints=\"5\""), "m.vtp", "4 points where NumberOfPoints is '5'"));
    EXPECT_TRUE(refused(replaced(ascii, "Float32", "Float16"), "m.vtp", "unknown type"));
    EXPECT_TRUE(refused(ascii, "m.obj", "looks like VTP, but the name says .obj"));
    EXPECT_TRUE(refused("<?xml version=\"1.0\"?><svg/>", "m.vtp", "XML text, not a mesh"));
}

TEST(Vtp, DamagedFilesGiveAMeshOrOneLineOfError) {
    for (const Form& form :
         {Form{true, false, true, false, false}, Form{true, true, true, true, true}, Form{false, true, false, false, false}}) {
        const std::string bytes = vtp(form);
        int refusals = 0;
        testing_tools::for_each_damage(bytes, [&](const std::string& damaged) {
            try {
                parse_mesh(damaged, "m.vtp", Keep::attributes);
            } catch (const InputError& error) {
                ++refusals;
                EXPECT_TRUE(testing_tools::is_one_line_about("m.vtp", error.what()));
            }
        });
        EXPECT_GT(refusals, static_cast<int>(bytes.size()));
    }
}
