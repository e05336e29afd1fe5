#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

#include "base/errors.h"
#include "base/in_quotes.h"
#include "base/joined.h"
#include "base/number_text.h"
#include "mesh/io/mesh_files.h"
#include "mesh/io/polygon_list.h"
#include "mesh/io/vtk_data.h"

namespace meshfolio {

namespace {

/// Reader of VTK's PolyData as XML (VTK, "VTK XML File Formats"): points, polygons and strips of all pieces, one after the other.
class VtpReader {
public:
    VtpReader(std::string_view bytes, const std::string& file, Keep keep)
        : vtk_(bytes, file), file_(file), keeps_columns_(keep == Keep::attributes) {}

    LoadedMesh run() {
        const pugi::xml_node data = vtk_.root().child("PolyData");
        if (!data) fail("holds " + in_quotes(vtk_.root().attribute("type").value()) + ", not PolyData", "save the surface as .vtp");
        for (const pugi::xml_node& piece : data.children("Piece")) read_piece(piece);
        if (!not_kept_.empty()) warnings_.add(0, "arrays that are not kept", "arrays that are not kept", joined(not_kept_, ", "));
        LoadedMesh loaded = triangulated(polygons_, Eigen::Map<const Positions>(points_.data(), vertices(), 3), file_, warnings_);
        for (const Column& column : columns_) {
            if (std::ssize(column.values) != vertices()) continue;                                        // not in every piece
            const bool is_long = column.type == ScalarType::int64 || column.type == ScalarType::uint64;   // which other formats lack
            const bool is_short = std::ranges::all_of(column.values, [](double x) { return fits_type(x, ScalarType::int32); });
            loaded.attributes.columns.push_back({column.name, Eigen::Map<const Vector>(column.values.data(), vertices()),
                                                 !is_long   ? column.type
                                                 : is_short ? ScalarType::int32
                                                            : ScalarType::float64,
                                                 column.parts > 1 ? column.array : ""});
        }
        return loaded;
    }

private:
    [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const { throw InputError({file_, 0}, problem, remedy); }

    Eigen::Index vertices() const { return static_cast<Eigen::Index>(points_.size() / 3); }

    void read_piece(const pugi::xml_node& piece) {
        for (const char* lower : {"NumberOfVerts", "NumberOfLines"})
            if (piece.attribute(lower).as_ullong() > 0) warnings_.add(0, "points or lines ignored", "sets of points or lines ignored");
        const std::size_t first = points_.size() / 3;
        const VtkArray points = vtk_.array(piece.child("Points").child("DataArray"));
        if (points.components != 3 || points.values.size() % 3 != 0) fail("points have no 3 coordinates each", "the file may be damaged");
        if (points.values.size() / 3 != piece.attribute("NumberOfPoints").as_ullong())
            fail(std::to_string(points.values.size() / 3) + " points where NumberOfPoints is " +
                     in_quotes(piece.attribute("NumberOfPoints").value()),
                 "the file may be damaged");
        for (const double x : points.values)
            if (!(std::abs(x) <= largest_coordinate)) fail("a coordinate is not finite or beyond 1e100", "every coordinate must be finite");
        points_.insert(points_.end(), points.values.begin(), points.values.end());
        for (const bool strips : {false, true}) read_cells(piece.child(strips ? "Strips" : "Polys"), strips, first);
        if (!keeps_columns_) return;
        for (const pugi::xml_node& element : piece.child("PointData").children("DataArray")) read_columns(element, first);
        for (const pugi::xml_node& element : piece.child("CellData").children()) not_kept(element.attribute("Name").value());
    }

    /// `offsets` says behind which entry of `connectivity` each cell ends.
    void read_cells(const pugi::xml_node& cells, bool strips, std::size_t first) {
        const pugi::xml_node connectivity = cells.find_child_by_attribute("DataArray", "Name", "connectivity");
        const pugi::xml_node offsets = cells.find_child_by_attribute("DataArray", "Name", "offsets");
        if (!connectivity || !offsets) return;
        const std::vector<double> corners = vtk_.array(connectivity).values;
        const auto points = static_cast<double>(points_.size() / 3 - first);
        for (const double corner : corners)
            if (!(corner >= 0 && corner < points && corner == std::floor(corner)))
                fail("index " + exact_text(corner) + " out of range (" + exact_text(points) + " points)", "indices count from 0");
        double begin = 0;
        for (const double end : vtk_.array(offsets).values) {
            if (!(end >= begin && end <= static_cast<double>(corners.size())))
                fail("offsets of cells do not rise", "the file may be damaged");
            const auto from = static_cast<std::size_t>(begin), count = static_cast<std::size_t>(end) - from;
            add_cell(std::span(corners).subspan(from, count), strips, static_cast<int>(first));
            begin = end;
        }
    }

    /// A polygon, or a strip, in which every second triangle is turned.
    void add_cell(std::span<const double> corners, bool is_strip, int first) {
        const std::size_t size = is_strip ? 3 : corners.size(), cells = is_strip ? std::max<std::size_t>(corners.size(), 2) - 2 : 1;
        for (std::size_t i = 0; i < cells; ++i) {
            for (std::size_t k = 0; k < size; ++k) {
                const std::size_t turned = is_strip && i % 2 == 1 && k < 2 ? 1 - k : k;
                polygons_.add_corner(first + static_cast<int>(corners[i + turned]));
            }
            polygons_.end_polygon(0);
        }
    }

    void read_columns(const pugi::xml_node& element, std::size_t first) {
        const std::string name = element.attribute("Name").value();
        if (element.attribute("type").value() == std::string_view("String")) return not_kept(name);
        const VtkArray array = vtk_.array(element);
        const auto parts = static_cast<std::size_t>(array.components);
        const std::size_t points = points_.size() / 3 - first;
        if (array.values.size() != parts * points)
            fail("array " + in_quotes(name) + " has not one entry a point", "the file may be damaged");
        for (std::size_t part = 0; part < parts; ++part) {
            const auto is_it = [&](const Column& c) { return c.array == name && c.part == part && c.parts == parts; };
            auto place = std::ranges::find_if(columns_, is_it);
            if (place == columns_.end())
                place = columns_.insert(place, {column_name(name, array, part), name, part, parts, array.type, {}});
            if (place->values.size() != first || place->type != array.type) continue;   // not in every piece
            for (std::size_t i = 0; i < points; ++i) place->values.push_back(array.values[parts * i + part]);
        }
    }

    /// As PLY calls it: the first colour by its channels.
    std::string column_name(const std::string& name, const VtkArray& array, std::size_t part) const {
        static constexpr std::array channels{"red", "green", "blue", "alpha"}, axes{"nx", "ny", "nz", ""};
        if (array.components == 1) return name;
        const bool is_color = array.type == ScalarType::uint8 && (array.components == 3 || array.components == 4);
        const std::string known = name == "Normals" && array.components == 3 ? axes[part] : is_color ? channels[part] : "";
        const bool is_free = std::ranges::find(columns_, known, &Column::name) == columns_.end();
        return !known.empty() && is_free ? known : component_name(name, part, static_cast<std::size_t>(array.components));
    }

    void not_kept(const std::string& array) {
        if (std::ranges::find(not_kept_, array) == not_kept_.end()) not_kept_.push_back(array);
    }

    struct Column {
        std::string name, array;
        std::size_t part, parts;   // of the array
        ScalarType type;
        std::vector<double> values;
    };

    VtkFile vtk_;
    const std::string& file_;
    bool keeps_columns_;
    WarningTally warnings_;
    std::vector<double> points_;   // x y z of each
    PolygonList polygons_;
    std::vector<Column> columns_;
    std::vector<std::string> not_kept_;
};

}   // namespace

LoadedMesh parse_vtp(std::string_view bytes, const std::string& file, Keep keep) { return VtpReader(bytes, file, keep).run(); }

}   // namespace meshfolio
