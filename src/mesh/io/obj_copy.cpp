#include "mesh/io/mesh_encoders.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "base/at.h"
#include "base/number_text.h"
#include "mesh/io/obj_gate.h"
#include "mesh/io/triangulate_polygon.h"

namespace meshfolio {

namespace {

/// Copies the text of an OBJ file with new positions and normals.
class ObjCopy {
public:
    ObjCopy(const Attributes& source, const TriangleMesh& mesh) : source_(source), mesh_(mesh), statements_(source.obj) {}

    std::string run() {
        std::size_t done = 0;
        while (statements_.next()) {
            out_->append(source_.obj, done, statements_.begin() - done);   // comments and empty lines
            done = statements_.end();
            std::string_view rest = statements_.text();
            const std::string_view keyword = take_word(rest);
            if (keyword == "v") vertex(rest);
            else if (keyword == "vn") ++normals_seen_;
            else if (keyword == "f" || keyword == "fo") face(rest);
            else if (keyword == "csh" || keyword == "call")   // would run a program or read another file
                continue;
            else if (statements_.ends_before_keyword()) out_->append(statements_.text()) += '\n';
            else out_->append(source_.obj, statements_.begin(), done - statements_.begin());
        }
        out_->append(source_.obj, done);
        for (const Vector3& sum : normals_) {
            const double length = std::hypot(sum.x(), sum.y(), sum.z());
            const Vector3 n = length > 0 ? Vector3(sum / length) : Vector3(0, 0, 1);
            before_faces_ += "vn " + plain_text(n.x()) + ' ' + plain_text(n.y()) + ' ' + plain_text(n.z()) + '\n';
        }
        std::string text = before_faces_ + from_faces_;
        std::erase(text, '\r');   // lines end in one way
        return text;
    }

private:
    struct Corner {
        std::string_view word, texture;   // "7/3/5", "3"
        int vertex;
        long long normal;   // from 0; −1: none
    };

    void vertex(std::string_view rest) {
        for (int axis = 0; axis < 3; ++axis) take_word(rest);
        const auto place = mesh_.X.row(vertices_seen_++);
        *out_ += "v " + exact_text(place.x()) + ' ' + exact_text(place.y()) + ' ' + exact_text(place.z());
        out_->append(rest) += '\n';   // a weight, a colour
    }

    /// Returns an index from 0 for an index of the file: indices below 0 count back from the last element so far.
    static long long index(std::string_view word, long long seen) {
        const long long number = parse_integer(word).value_or(0);
        return number < 0 ? seen + number : number - 1;
    }

    Corner corner(std::string_view word) const {
        Corner corner{word, {}, static_cast<int>(index(word.substr(0, word.find('/')), vertices_seen_)), -1};
        const std::size_t first = word.find('/'), second = word.find('/', first + 1);
        if (first == std::string_view::npos) return corner;
        corner.texture = word.substr(first + 1, second - first - 1);
        if (second != std::string_view::npos) corner.normal = index(word.substr(second + 1), normals_seen_);
        return corner;
    }

    void face(std::string_view rest) {
        out_ = &from_faces_;
        corners_.clear();
        for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) corners_.push_back(corner(word));
        const int begin = triangle_;
        while (triangle_ < mesh_.face_count() && source_.face_lines[at(triangle_)] == statements_.line()) ++triangle_;
        const bool whole = is_whole(begin);
        if (whole) *out_ += 'f';
        for (int t = begin; t < triangle_; ++t) {
            if (!whole) *out_ += 'f';
            const Vector3 a = mesh_.X.row(mesh_.F(t, 0)), b = mesh_.X.row(mesh_.F(t, 1)), c = mesh_.X.row(mesh_.F(t, 2));
            const Vector3 normal = (b - a).cross(c - a);
            for (int k = 0; k < 3; ++k) {
                const Corner& corner = *std::ranges::find(corners_, mesh_.F(t, k), &Corner::vertex);
                if (corner.normal >= 0) normals_[at(number_of(corner))] += normal;
                if (!whole) write(corner);
            }
            if (!whole) *out_ += '\n';
        }
        if (!whole) return;
        for (const Corner& corner : corners_) write(corner);
        *out_ += '\n';
    }

    /// True if the polygon, when it is read again, becomes the triangles from `begin` on.
    bool is_whole(int begin) {
        const auto count = static_cast<Eigen::Index>(corners_.size());
        if (triangle_ == begin || triangle_ - begin != count - 2) return false;
        std::vector<int> vertices;
        for (const Corner& corner : corners_) vertices.push_back(corner.vertex);
        const Faces triangles = triangulated_polygon(mesh_.X(vertices, Eigen::all)).triangles;
        return triangles.rows() == count - 2 &&
               triangles.unaryExpr([&](int k) { return vertices[at(k)]; }) == mesh_.F.middleRows(begin, count - 2);
    }

    /// Returns the number of the corner's new normal. Corners that share vertex and normal share the new one.
    int number_of(const Corner& corner) {
        const auto key = static_cast<std::uint64_t>(corner.vertex) << 32 | static_cast<std::uint32_t>(corner.normal);
        const auto [place, is_new] = numbers_.try_emplace(key, static_cast<int>(normals_.size()));
        if (is_new) normals_.emplace_back(0, 0, 0);
        return place->second;
    }

    void write(const Corner& corner) {
        out_->append(" ").append(corner.word.substr(0, corner.word.find('/')));
        if (!corner.texture.empty() || corner.normal >= 0) out_->append("/").append(corner.texture);
        if (corner.normal >= 0) out_->append("/").append(std::to_string(number_of(corner) + 1));
    }

    const Attributes& source_;
    const TriangleMesh& mesh_;
    ObjStatements statements_;
    std::string before_faces_, from_faces_;   // normals come between
    std::string* out_ = &before_faces_;
    Eigen::Index vertices_seen_ = 0;
    long long normals_seen_ = 0;
    int triangle_ = 0;   // the next one
    std::vector<Corner> corners_;
    std::vector<Vector3> normals_;   // sums
    std::unordered_map<std::uint64_t, int> numbers_;
};

}   // namespace

std::string obj_with_positions(const Attributes& source, const TriangleMesh& mesh) { return ObjCopy(source, mesh).run(); }

}   // namespace meshfolio
