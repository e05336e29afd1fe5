#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "base/at.h"
#include "base/in_quotes.h"
#include "mesh/io/glb/glb_columns.h"
#include "mesh/io/glb/glb_scene.h"
#include "mesh/io/mesh_files.h"

namespace meshfolio {

namespace {

using Json = GlbDocument::Json;

/// Reads binary glTF 2.0 with all data in its own chunk: the triangles of its scene at rest, in the places of their nodes. Vertices that a
/// mesh repeats for each normal or texture coordinate are welded; those of different nodes are not.
class GlbReader {
public:
    GlbReader(std::string_view bytes, const std::string& file, Keep keep)
        : file_(file), keeps_columns_(keep == Keep::attributes), document_(bytes, file, warnings_), columns_(document_, warnings_) {}

    LoadedMesh run() {
        global_ = global_transformations(document_);
        const std::vector<std::size_t> nodes = shown_nodes(document_);
        is_alone_ = has_one_primitive(nodes);
        for (const std::size_t node : nodes)
            if (document_.entry("nodes", node).contains("mesh")) place_node(node);
        if (document_.size_of_list("nodes") == 0)
            for (std::size_t mesh = 0; mesh < document_.size_of_list("meshes"); ++mesh)
                place_mesh(document_.entry("meshes", mesh), {}, Eigen::Matrix4d::Identity(), nullptr);
        if (corners_.empty()) document_.fail("no triangles", "export the mesh with its faces");
        WeldedMesh mesh = welded(points_, corners_, {}, file_, WarningTally(), placed_);
        if (keeps_columns_) mesh.loaded.attributes.columns = columns_.of_vertices(mesh);
        const std::vector<MeshWarning> own_warnings = warnings_.warnings();
        mesh.loaded.warnings.insert(mesh.loaded.warnings.begin(), own_warnings.begin(), own_warnings.end());
        return std::move(mesh.loaded);
    }

private:
    /// True if the nodes show one primitive, once. It keeps vertices that no triangle uses, as in other formats.
    bool has_one_primitive(const std::vector<std::size_t>& nodes) const {
        std::size_t primitives = 0;
        for (const std::size_t number : nodes) {
            const Json& node = document_.entry("nodes", number);
            if (!node.contains("mesh")) continue;
            primitives += node.contains("extensions") ? 2 : 0;   // instances
            primitives += document_.entry("meshes", document_.number(node, "mesh", 0)).at("primitives").size();
        }
        return primitives == 1;
    }

    void place_node(std::size_t number) {
        const Json& node = document_.entry("nodes", number);
        const Json& mesh = document_.entry("meshes", document_.number(node, "mesh", 0));
        const auto weights = node.value("weights", mesh.value("weights", std::vector<double>()));   // §3.7.2.2
        const std::vector<Eigen::Matrix4d> instances = instances_of(document_, node);
        const std::vector<Eigen::Matrix4d>* joints = nullptr;
        if (node.contains("skin")) {
            const auto [of_skin, is_new] = joints_.try_emplace(document_.number(node, "skin", 0));
            if (is_new) of_skin->second = joints_of(document_, of_skin->first, global_);
            joints = &of_skin->second;
            if (instances.size() > 1) document_.fail("instances of a skinned mesh are not supported", "export one of each mesh");
        }
        for (const Eigen::Matrix4d& instance : instances) place_mesh(mesh, weights, global_[number] * instance, joints);
    }

    void place_mesh(const Json& mesh, const std::vector<double>& weights, const Eigen::Matrix4d& place,
                    const std::vector<Eigen::Matrix4d>* joints) {
        placed_.push_back(points_.size());
        for (const Json& primitive : mesh.at("primitives")) {
            document_.spend(8);
            const std::size_t mode = document_.number(primitive, "mode", 4);
            if (mode < 4 || mode > 6) {
                warnings_.add(0, "points or lines ignored", "sets of points or lines ignored");
                continue;
            }
            // Compressed primitives have no data. A file that requires the extension has been refused before.
            if (primitive.contains("extensions") && primitive["extensions"].contains("KHR_draco_mesh_compression") &&
                !document_.entry("accessors", document_.number(primitive.at("attributes"), "POSITION", 0)).contains("bufferView"))
                document_.fail("needs the extension 'KHR_draco_mesh_compression'", "export it without compression or extensions");
            const GlbShape shape(document_, primitive, weights, joints, warnings_);
            std::vector<std::uint32_t> corners = corners_of(primitive, shape.vertex_count());
            if (corners.empty()) continue;
            const std::size_t first = points_.size();
            const std::vector<std::uint32_t> vertices = used_vertices(corners, shape.vertex_count());
            const bool turned = add_points(shape, vertices, place);
            if (keeps_columns_) columns_.add(primitive, vertices, first);
            add_triangles(corners, mode, static_cast<int>(first), turned);
        }
    }

    /// Returns the corners of the triangles, in the order of the primitive, as indices of its points.
    std::vector<std::uint32_t> corners_of(const Json& primitive, std::size_t points) {
        std::vector<std::uint32_t> corners;
        if (!primitive.contains("indices")) {
            document_.refuse_too_many(corners_.size() / 3 + points / 3);
            corners.resize(points);
            std::iota(corners.begin(), corners.end(), 0);
            return corners;
        }
        const GlbAccessor indices = document_.accessor(document_.number(primitive, "indices", 0));
        if (indices.components != 1 || !is_integer(indices.type)) document_.damaged("indices are no whole numbers");
        document_.refuse_too_many(corners_.size() / 3 + indices.count / 3);
        corners.reserve(indices.count);
        for (std::size_t i = 0; i < indices.count; ++i) {
            const double index = indices(i, 0);
            if (!(index >= 0 && index < static_cast<double>(points)))
                document_.damaged("index " + std::to_string(static_cast<long long>(index)) + " out of range (" + std::to_string(points) +
                                  " vertices)");
            corners.push_back(static_cast<std::uint32_t>(index));
        }
        return corners;
    }

    /// Returns the points that are used, ascending, and makes `corners` indices of these. A buffer may serve many primitives (§3.7.2), so
    /// that only the points count that the triangles of this one use.
    std::vector<std::uint32_t> used_vertices(std::vector<std::uint32_t>& corners, std::size_t count) const {
        if (is_alone_) {
            document_.refuse_too_many(count);
            std::vector<std::uint32_t> all(count);
            std::iota(all.begin(), all.end(), 0);
            return all;
        }
        std::vector<std::uint32_t> used = corners;
        std::ranges::sort(used);
        used.erase(std::unique(used.begin(), used.end()), used.end());
        for (std::uint32_t& corner : corners) corner = static_cast<std::uint32_t>(std::ranges::lower_bound(used, corner) - used.begin());
        return used;
    }

    /// Adds vertices of a shape. Returns true if they are mirrored, which turns triangles (§3.5.3).
    bool add_points(const GlbShape& shape, const std::vector<std::uint32_t>& vertices, const Eigen::Matrix4d& place) {
        document_.refuse_too_many(points_.size() + vertices.size());
        document_.spend(vertices.size() * shape.cost());
        bool is_mirrored = false;
        for (const std::uint32_t v : vertices) {
            const Eigen::Matrix4d matrix = shape.matrix(v, place);
            const Vector3 x = (matrix * shape.vertex(v)).head<3>();
            if (v == vertices[0]) is_mirrored = matrix.topLeftCorner<3, 3>().determinant() < 0;
            if (!(x.cwiseAbs().array() <= largest_coordinate).all())
                document_.fail("vertex " + std::to_string(v) + ": coordinate is not finite or out of the supported range (1e100)",
                               "every coordinate must be finite");
            points_.push_back({x[0], x[1], x[2]});
        }
        return is_mirrored;
    }

    /// Adds separate triangles (mode 4), a strip with every second triangle turned (5), or a fan (6).
    void add_triangles(const std::vector<std::uint32_t>& corners, std::size_t mode, int first, bool turned) {
        if (mode == 4 && corners.size() % 3 != 0) document_.damaged("the number of corners is no multiple of 3");
        const std::size_t step = mode == 4 ? 3 : 1;
        document_.refuse_too_many(corners_.size() / 3 + corners.size() / step);
        for (std::size_t i = 0; i + 2 < corners.size(); i += step) {
            std::array<std::uint32_t, 3> triangle{corners[mode == 6 ? 0 : i], corners[i + 1], corners[i + 2]};
            if ((mode == 5 && i % 2 == 1) != turned) std::swap(triangle[0], triangle[1]);
            for (const std::uint32_t corner : triangle) corners_.push_back(first + static_cast<int>(corner));
        }
    }

    const std::string& file_;
    bool keeps_columns_, is_alone_ = false;
    WarningTally warnings_;
    GlbDocument document_;
    GlbColumns columns_;
    std::vector<Eigen::Matrix4d> global_;                          // of nodes
    std::map<std::size_t, std::vector<Eigen::Matrix4d>> joints_;   // of skins
    std::vector<std::array<double, 3>> points_;
    std::vector<std::size_t> placed_;   // the first point of each mesh that a node places
    std::vector<int> corners_;          // of triangles, as indices of points
};

}   // namespace

LoadedMesh parse_glb(std::string_view bytes, const std::string& file, Keep keep) try {
    return GlbReader(bytes, file, keep).run();
} catch (const Json::exception& error) {
    throw InputError({file, 0}, "no valid glTF: " + in_quotes(error.what(), 160), "the file may be damaged");
}

}   // namespace meshfolio
