#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "base/at.h"
#include "base/errors.h"
#include "base/joined.h"
#include "base/linux_only.h"
#include "base/parallel.h"
#include "mesh/io/mesh_files.h"
#include "mesh/io/ply_body.h"
#include "mesh/io/polygon_list.h"

namespace meshfolio {

namespace {

/// Reads the elements in the order of the header.
template <class Body> class PlyReader {
public:
    PlyReader(const PlyHeader& header, const PlyMeshParts& parts, Body body, const std::string& file)
        : header_(header), parts_(parts), body_(std::move(body)), file_(file), X_(parts.vertices->count, 3) {
        prefer_large_pages(X_.data(), static_cast<std::size_t>(X_.size()) * sizeof(double));
    }

    LoadedMesh run(WarningTally warnings, Keep keep) {
        // A column for every property of a vertex that is one number and no coordinate.
        const std::vector<PlyProperty>& properties = parts_.vertices->properties;
        column_of_.assign(properties.size(), -1);
        for (std::size_t p = 0; p < properties.size(); ++p) {
            if (keep == Keep::mesh || properties[p].is_list || std::ranges::find(parts_.axis, p) != parts_.axis.end()) continue;
            column_of_[p] = static_cast<int>(columns_.size());
            columns_.push_back({properties[p].name, Vector(parts_.vertices->count), properties[p].type});
        }
        for (const PlyElement& element : header_.elements)
            if (&element == parts_.vertices) read_vertices(element);
            else read_others(element);
        body_.end(warnings);
        if (const std::string names = first_of_many(not_kept()); keep == Keep::attributes && !names.empty())
            warnings.add(0, "properties that are not kept", "properties that are not kept", names);
        LoadedMesh loaded = F_.rows() > 0 ? LoadedMesh{{std::move(X_), std::move(F_)}, file_, {}, warnings.warnings()}
                                          : triangulated(polygons_, std::move(X_), file_, std::move(warnings));
        loaded.attributes.columns = std::move(columns_);
        return loaded;
    }

private:
    [[noreturn]] void fail(long line, const std::string& problem, const std::string& remedy) const {
        throw InputError({file_, line}, problem, remedy);
    }

    /// Returns the names of other elements than vertices and faces, of properties of faces other than corners, and of lists of vertices.
    std::vector<std::string> not_kept() const {
        std::vector<std::string> names;
        for (const PlyElement& element : header_.elements) {
            const bool is_vertex = &element == parts_.vertices, is_part = is_vertex || &element == parts_.faces;
            if (!is_part && &element != parts_.ignored && element.count > 0) names.push_back(element.name);
            for (std::size_t p = 0; is_part && p < element.properties.size(); ++p)
                if (is_vertex ? element.properties[p].is_list : !parts_.is_corners(element, p)) names.push_back(element.properties[p].name);
        }
        return names;
    }

    /// Reads all rows of an element of a binary file at once, as if each list had three items. good(body, i, values) stores row i, of which
    /// property p is at values(p), and returns whether it is right. Returns false if a row is not: they must be read one by one then.
    template <class Good> bool read_even_rows(const PlyElement& element, const Good& good) {
        if constexpr (std::is_same_v<Body, BinaryBody>) {
            std::vector<std::size_t> offset;
            std::size_t size = 0;
            for (const PlyProperty& p : element.properties) {
                offset.push_back(size);
                size += p.is_list ? size_of(p.count_type) + 3 * size_of(p.type) : size_of(p.type);
            }
            const char* const rows = body_.rows(element.count, size);
            const auto good_row = [&](int i) { return good(body_, i, [&](std::size_t p) { return rows + at(i) * size + offset[p]; }); };
            if (rows == nullptr || !all_of_range(static_cast<int>(element.count), good_row)) return false;
            body_.skip_rows(element.count, size);
            return true;
        } else {
            return false;
        }
    }

    bool read_even_vertices(const PlyElement& element) {
        if (std::ranges::any_of(element.properties, &PlyProperty::is_list) || !columns_.empty()) return false;
        return read_even_rows(element, [&](const auto& body, int i, const auto& values) {
            bool good = true;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t p = parts_.axis[k];
                const double x = body.number_at(values(p), element.properties[p].type);
                X_(i, static_cast<int>(k)) = x;
                good &= std::abs(x) <= largest_coordinate;
            }
            return good;
        });
    }

    bool read_even_triangles(const PlyElement& element) {
        if (std::ranges::count_if(element.properties, &PlyProperty::is_list) > 1 || element.count > most_triangles) return false;
        const PlyProperty& list = element.properties[parts_.corners];
        const std::size_t length = size_of(list.count_type), item = size_of(list.type);
        Faces F(element.count, 3);
        prefer_large_pages(F.data(), static_cast<std::size_t>(F.size()) * sizeof(int));
        const bool read = read_even_rows(element, [&](const auto& body, int i, const auto& values) {
            const char* const raw = values(parts_.corners);
            bool good = body.number_at(raw, list.count_type) == 3;
            for (std::size_t k = 0; k < 3; ++k) {
                const double v = body.number_at(raw + length + k * item, list.type);
                const bool exists = v >= 0 && v < static_cast<double>(parts_.vertices->count);
                F(i, static_cast<int>(k)) = exists ? static_cast<int>(v) : 0;
                good &= exists;
            }
            return good;
        });
        if (read) F_ = std::move(F);
        return read;
    }

    /// Calls read(i, p) for each property p of each row i.
    template <class Read> void for_each_value(const PlyElement& element, const Read& read) {
        for (long long i = 0; i < element.count; ++i) {
            body_.begin_row(element);
            for (std::size_t p = 0; p < element.properties.size(); ++p) read(i, p);
            body_.end_row(element);
        }
    }

    void read_vertices(const PlyElement& element) {
        if (read_even_vertices(element)) return;
        for_each_value(element, [&](long long i, std::size_t p) {
            const PlyProperty& property = element.properties[p];
            const auto axis = std::find(parts_.axis.begin(), parts_.axis.end(), p) - parts_.axis.begin();
            if (axis == std::ssize(parts_.axis)) {
                if (column_of_[p] < 0) return skip_value(property);
                columns_[at(column_of_[p])].values[i] = body_.any_number(property.type);
                return;
            }
            const double x = X_(i, axis) = body_.number(property.type);
            if (std::abs(x) <= largest_coordinate) return;
            const std::string name = "vertex " + std::to_string(i) + ": " + "xyz"[axis];
            if (!std::isfinite(x)) fail(body_.line(), name + (std::isnan(x) ? " is nan" : " is inf"), "every coordinate must be finite");
            fail(body_.line(), name + ": coordinate out of the supported range (1e100)", "scale the mesh down");
        });
    }

    /// Reads faces or strips; skips other elements.
    void read_others(const PlyElement& element) {
        const bool are_faces = &element == parts_.faces && !parts_.are_strips;
        if (are_faces && read_even_triangles(element)) return;
        if (are_faces) polygons_.reserve(static_cast<std::size_t>(element.count));
        for_each_value(element, [&](long long i, std::size_t p) {
            const PlyProperty& property = element.properties[p];
            if (!parts_.is_corners(element, p)) skip_value(property);
            else if (are_faces) read_corners(i, property);
            else read_strip_list(i, property);
        });
    }

    void read_corners(long long face, const PlyProperty& property) {
        const long long corners = list_length(property);
        for (long long k = 0; k < corners; ++k) polygons_.add_corner(checked_index(body_.integer(property.type), "face ", face));
        polygons_.end_polygon(body_.line());
    }

    int checked_index(long long index, const char* what, long long number) const {
        if (index < 0 || index >= parts_.vertices->count)
            fail(body_.line(),
                 what + std::to_string(number) + ": index " + std::to_string(index) + " out of range (" +
                     std::to_string(parts_.vertices->count) + " vertices)",
                 "indices are whole numbers from 0");
        return static_cast<int>(index);
    }

    /// Reads strips, each ended by −1 or by the end of the list.
    void read_strip_list(long long row, const PlyProperty& property) {
        const long long items = list_length(property);
        std::vector<int> strip;
        for (long long k = 0; k <= items; ++k) {
            const long long index = k < items ? body_.integer(property.type) : -1;
            if (index != -1) {
                strip.push_back(checked_index(index, "tristrips ", row));
                continue;
            }
            polygons_.add_strip(strip, body_.line());
            if (strip.size() == 1 || strip.size() == 2) polygons_.add_polygon(strip, body_.line());   // to be warned of
            strip.clear();
        }
    }

    long long list_length(const PlyProperty& property) {
        const long long length = body_.integer(property.count_type);
        if (length < 0 || length > std::numeric_limits<std::uint32_t>::max())
            fail(body_.line(), "list of " + std::to_string(length) + " items", "the file may be damaged");
        return length;
    }

    void skip_value(const PlyProperty& property) { body_.skip(property.type, property.is_list ? list_length(property) : 1); }

    const PlyHeader& header_;
    const PlyMeshParts& parts_;
    Body body_;
    const std::string& file_;
    Positions X_;
    Faces F_;   // if they could be read at once; else:
    PolygonList polygons_;
    std::vector<VertexColumn> columns_;   // if they are kept
    std::vector<int> column_of_;          // the column of each property of a vertex; −1: none
};

}   // namespace

LoadedMesh parse_ply(std::string_view bytes, const std::string& file, Keep keep) {
    WarningTally warnings;
    if (without_bom(bytes).size() < bytes.size()) warnings.add(1, "byte order mark ignored", "byte order marks ignored");
    bytes = without_bom(bytes);
    const PlyHeader header = parse_ply_header(bytes, file);
    const PlyMeshParts parts = mesh_parts(header, file);
    if (parts.ignored != nullptr)
        warnings.add(parts.ignored->line, "tristrips beside faces ignored", "elements of tristrips beside faces ignored");
    if (header.format == PlyHeader::Format::ascii) return PlyReader(header, parts, TextBody(bytes, header, file), file).run(warnings, keep);
    return PlyReader(header, parts, BinaryBody(bytes, header, file), file).run(warnings, keep);
}

}   // namespace meshfolio
