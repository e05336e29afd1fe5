#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "base/errors.h"
#include "base/in_quotes.h"
#include "base/joined.h"
#include "base/number_text.h"
#include "mesh/io/mesh_files.h"
#include "mesh/io/polygon_list.h"
#include "mesh/io/vtk_data.h"

namespace meshfolio {

namespace {

constexpr std::size_t most_columns = 10000;   // numbers per point, of all arrays

/// Reader of VTK's PolyData as XML (VTK, "VTK XML File Formats"): points, polygons and strips of all pieces, one after the other.
class VtpReader {
public:
    VtpReader(std::string_view bytes, const std::string& file, Keep keep)
        : vtk_(bytes, file), file_(file), keeps_columns_(keep == Keep::attributes) {}

    LoadedMesh run() {
        const pugi::xml_node data = vtk_.root().child("PolyData");
        if (!data) fail("holds " + in_quotes(vtk_.root().attribute("type").value()) + ", not PolyData", "save the surface as .vtp");
        for (const pugi::xml_node& piece : data.children("Piece")) read_piece(piece);
        if (!not_kept_.empty())
            warnings_.add(0, "arrays that are not kept", "arrays that are not kept", first_of_many({not_kept_.begin(), not_kept_.end()}));
        LoadedMesh loaded = triangulated(polygons_, Eigen::Map<const Positions>(points_.data(), vertices(), 3), file_, warnings_);
        for (const Column& column : columns_) {
            if (std::ssize(column.values) != vertices()) continue;                                        // not in every piece
            const bool is_long = column.type == ScalarType::int64 || column.type == ScalarType::uint64;   // other formats lack them
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
        const Ghosts ghosts = ghosts_of(piece, points.values.size() / 3);
        std::size_t cell = piece.attribute("NumberOfVerts").as_ullong() + piece.attribute("NumberOfLines").as_ullong();
        for (const bool strips : {false, true}) cell = read_cells(piece.child(strips ? "Strips" : "Polys"), strips, first, ghosts, cell);
        if (!ghosts.cells.empty() && ghosts.cells.size() != cell)
            fail("the array of ghosts has not one entry a cell", "the file may be damaged");
        if (!keeps_columns_ || points.values.empty()) return;
        for (const pugi::xml_node& element : piece.child("PointData").children("DataArray")) read_columns(element, first);
        for (const pugi::xml_node& element : piece.child("CellData").children())
            if (!is_ghost_array(element)) not_kept_.insert(element.attribute("Name").value());
    }

    /// Points and cells of a piece that are in others as well, or hidden (vtkDataSetAttributes, bits of vtkGhostType).
    struct Ghosts {
        std::vector<double> points, cells;   // empty: no ghosts
        bool levels = false;                 // cells hold levels (vtkGhostLevels, the earlier array): 0, or the distance from the piece
    };

    static bool is_ghost_array(const pugi::xml_node& element) {
        const std::string_view name = element.attribute("Name").value();
        return name == "vtkGhostType" || name == "vtkGhostLevels";
    }

    Ghosts ghosts_of(const pugi::xml_node& piece, std::size_t points) {
        Ghosts ghosts;
        const pugi::xml_node point_ghosts = piece.child("PointData").find_child_by_attribute("DataArray", "Name", "vtkGhostType");
        const pugi::xml_node cell_ghosts = piece.child("CellData").find_child(is_ghost_array);
        ghosts.levels = cell_ghosts.attribute("Name").value() == std::string_view("vtkGhostLevels");
        if (point_ghosts) ghosts.points = vtk_.array(point_ghosts).values;
        if (cell_ghosts) ghosts.cells = vtk_.array(cell_ghosts).values;
        if (point_ghosts && ghosts.points.size() != points)
            fail("the array of ghosts has not one entry a point", "the file may be damaged");
        return ghosts;
    }

    /// True if a cell of a piece is left out: a ghost, a cell with a hidden point or, without ghost cells, one of duplicate points alone.
    static bool is_left_out(const Ghosts& ghosts, std::size_t cell, std::span<const double> corners) {
        constexpr unsigned duplicate_cell = 1, refined_cell = 8, hidden_cell = 32, duplicate_point = 1, hidden_point = 2;
        const auto bits = [](double x) { return x >= 0 && x <= 255 ? static_cast<unsigned>(x) : 0U; };
        const auto is_point = [&](unsigned kind) {
            return [&ghosts, bits, kind](double corner) { return (bits(ghosts.points[static_cast<std::size_t>(corner)]) & kind) != 0; };
        };
        if (cell < ghosts.cells.size()) {
            const unsigned kind = bits(ghosts.cells[cell]);
            if (ghosts.levels ? kind > 0 : (kind & (duplicate_cell | refined_cell | hidden_cell)) != 0) return true;
        }
        if (ghosts.points.empty()) return false;
        if (std::ranges::any_of(corners, is_point(hidden_point))) return true;
        return ghosts.cells.empty() && std::ranges::all_of(corners, is_point(duplicate_point));
    }

    /// Reads polygons or strips; `offsets` holds the end of each cell in `connectivity`. Returns the number of the next cell.
    std::size_t read_cells(const pugi::xml_node& cells, bool strips, std::size_t first, const Ghosts& ghosts, std::size_t cell) {
        const pugi::xml_node connectivity = cells.find_child_by_attribute("DataArray", "Name", "connectivity");
        const pugi::xml_node offsets = cells.find_child_by_attribute("DataArray", "Name", "offsets");
        if (!connectivity || !offsets) return cell;
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
            const std::span<const double> cell_corners = std::span(corners).subspan(from, count);
            begin = end;
            if (is_left_out(ghosts, cell++, cell_corners)) {
                warnings_.add(0, "ghost or hidden cell left out", "ghost or hidden cells left out");
                continue;
            }
            std::vector<int> vertices;
            for (const double corner : cell_corners) vertices.push_back(static_cast<int>(first) + static_cast<int>(corner));
            strips ? polygons_.add_strip(vertices, 0) : polygons_.add_polygon(vertices, 0);
        }
        return cell;
    }

    void read_columns(const pugi::xml_node& element, std::size_t first) {
        const std::string name = element.attribute("Name").value();
        if (element.attribute("type").value() == std::string_view("String")) {
            not_kept_.insert(name);
            return;
        }
        const VtkArray array = vtk_.array(element);
        const auto parts = static_cast<std::size_t>(array.components);
        const std::size_t points = points_.size() / 3 - first;
        if (array.values.size() != parts * points)
            fail("array " + in_quotes(name) + " has not one entry a point", "the file may be damaged");
        const auto [place, is_new] = first_columns_.try_emplace({name, parts}, columns_.size());
        if (is_new && columns_.size() + parts > most_columns)
            fail("more than " + std::to_string(most_columns) + " numbers a point, array " + in_quotes(name), "leave arrays out");
        for (std::size_t part = 0; part < parts; ++part) {
            if (is_new) columns_.push_back({column_name(name, array, part), name, part, parts, array.type, {}});
            if (is_new) names_.insert(columns_.back().name);
            Column& column = columns_[place->second + part];
            if (column.values.size() != first || column.type != array.type) continue;   // not in every piece
            for (std::size_t i = 0; i < points; ++i) column.values.push_back(array.values[parts * i + part]);
        }
    }

    /// Returns the name of a column, by the conventions of PLY for normals and for the first colour.
    std::string column_name(const std::string& name, const VtkArray& array, std::size_t part) const {
        static constexpr std::array channels{"red", "green", "blue", "alpha"}, axes{"nx", "ny", "nz", ""};
        if (array.components == 1) return name;
        const bool is_color = array.components == 3 ? array.type == ScalarType::uint8 || name == "RGB"
                                                    : array.components == 4 && (array.type == ScalarType::uint8 || name == "RGBA");
        const std::string known = name == "Normals" && array.components == 3 ? axes[part] : is_color ? channels[part] : "";
        return !known.empty() && !names_.contains(known) ? known : component_name(name, part, static_cast<std::size_t>(array.components));
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
    std::map<std::pair<std::string, std::size_t>, std::size_t> first_columns_;   // of arrays, by name and components
    std::set<std::string> names_, not_kept_;                                     // names of columns; names of arrays
};

}   // namespace

LoadedMesh parse_vtp(std::string_view bytes, const std::string& file, Keep keep) { return VtpReader(bytes, file, keep).run(); }

}   // namespace meshfolio
