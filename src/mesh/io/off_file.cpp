#include <limits>

#include "base/errors.h"
#include "base/in_quotes.h"
#include "base/number_text.h"
#include "mesh/io/mesh_files.h"
#include "mesh/io/polygon_list.h"
#include "mesh/io/text_scanner.h"

namespace meshfolio {

namespace {

bool take_prefix(std::string_view& word, std::string_view prefix) {
    if (!word.starts_with(prefix)) return false;
    word.remove_prefix(prefix.size());
    return true;
}

/// Reader of Geomview's object file format (geomview.org, "OFF Files"). White space is free with one exception: numbers behind the
/// coordinates of a vertex, or behind the corners of a face, belong to them if they are on the same line (colours, normals) and are left
/// out.
class OffReader {
public:
    OffReader(std::string_view text, const std::string& file) : size_(text.size()), words_(text), file_(file) {}

    LoadedMesh run() {
        std::string_view first = words_.next();
        if (!first.empty() && first.find_first_not_of("+-.0123456789") == std::string_view::npos) {
            warnings_.add(words_.line(), "no OFF keyword, assumed", "OFF keywords assumed");
        } else {
            read_keyword(first);
            first = words_.next();
        }
        read_counts(first);
        for (long long i = 0; i < vertices_; ++i) read_vertex(i);
        polygons_.reserve(static_cast<std::size_t>(faces_));
        for (long long i = 0; i < faces_; ++i) read_face(i);
        if (!words_.next().empty()) warnings_.add(words_.line(), "text after the last face ignored", "texts after the last face ignored");
        return triangulated(polygons_, std::move(X_), file_, warnings_);
    }

private:
    [[noreturn]] void fail(long line, const std::string& problem, const std::string& remedy) const {
        throw InputError({file_, line}, problem, remedy);
    }

    /// Reads the keyword [ST][C][N][4][n]OFF. Its letters stand for the numbers on a vertex line.
    void read_keyword(std::string_view keyword) {
        const long line = words_.line();
        std::string_view rest = keyword;
        name_ = std::string(keyword.substr(0, 8));
        if (take_prefix(rest, "ST")) fewest_numbers_ += 2;
        if (take_prefix(rest, "C")) fewest_numbers_ += 3;
        if (take_prefix(rest, "N")) fewest_numbers_ += 3;
        const bool four = take_prefix(rest, "4");
        const bool any_dimension = take_prefix(rest, "n");
        if (rest != "OFF") fail(line, in_quotes(keyword) + " is not an OFF keyword", "an OFF file begins with OFF");
        if (four || any_dimension)
            fail(line, name_ + (any_dimension ? " (n-dimensional vertices)" : " (4-component vertices)") + " is not supported",
                 "export the mesh with x y z vertices");
        std::string_view same_line = words_.rest_of_line();
        if (take_word(same_line) == "BINARY") fail(line, "binary OFF is not supported", "save it as text");
    }

    /// Reads the counts of vertices, faces and edges. The last is not needed, and often wrong or missing.
    void read_counts(std::string_view first) {
        if (first.empty()) fail(0, "no counts after " + name_, "the file may be cut off");
        counts_line_ = words_.line();
        vertices_ = count(first, "vertex");
        faces_ = count(words_.next(), "face");
        const std::string_view edges = words_.next_on_line();
        if (edges.empty()) warnings_.add(counts_line_, "edge count missing", "edge counts missing");
        else if (!parse_integer(edges)) fail(counts_line_, "bad edge count " + in_quotes(edges), "it must be a whole number");
        words_.skip_line();
        // The shortest vertex is "0 0 0" and a line end, the shortest face "0" and one; the last line end may be missing.
        const auto room = static_cast<long long>(size_ - words_.offset()) + 1;
        constexpr long long most = std::numeric_limits<int>::max();
        if (vertices_ >= 0 && faces_ == 0 && vertices_ <= room / 6) {
            fail(counts_line_, "no faces (" + vertex_count(vertices_) + " alone)",
                 vertices_ == 0 ? "export the mesh again" : "points are not a mesh; export it with its faces");
        }
        if (vertices_ < 1 || faces_ < 1 || vertices_ > most || faces_ > most || vertices_ > room / 6 || faces_ > room / 2)
            fail(counts_line_,
                 "impossible counts (" + vertex_count(vertices_) + ", " + std::to_string(faces_) + " faces in a file of " +
                     std::to_string(size_) + " bytes)",
                 "the file may be cut off or damaged");
        X_.resize(vertices_, 3);
    }

    long long count(std::string_view word, const std::string& of_what) const {
        const std::optional<long long> value = parse_integer(word);
        if (!value) fail(words_.line(), "bad " + of_what + " count " + in_quotes(word), "it must be a whole number");
        return *value;
    }

    void read_vertex(long long i) {
        int numbers = 0;
        for (int axis = 0; axis < 3; ++axis, ++numbers) {
            // A vertex with normals or colours must be on one line: free white space would hide missing numbers.
            const std::string_view word = axis == 0 || fewest_numbers_ == 3 ? words_.next() : words_.next_on_line();
            if (word.empty() && axis > 0 && fewest_numbers_ > 3) break;
            if (word.empty())
                fail(words_.line(), "ends early: vertex " + std::to_string(i + 1) + " of " + std::to_string(vertices_) + " is missing",
                     "the file may be cut off");
            X_(i, axis) = checked_coordinate(word, file_, words_.line());
        }
        while (!words_.next_on_line().empty()) ++numbers;
        if (numbers < fewest_numbers_)
            fail(words_.line(), name_ + " vertex needs " + std::to_string(fewest_numbers_) + " numbers, has " + std::to_string(numbers),
                 "check the keyword on the first line");
        if (numbers > 3 && fewest_numbers_ == 3)
            warnings_.add(words_.line(), "extra numbers on a vertex ignored", "vertices with extra numbers, which are ignored");
    }

    void read_face(long long i) {
        const std::string_view word = words_.next();
        const long line = words_.line();
        if (word.empty()) {   // a face that continues on the next line is allowed, but then it may have taken another face
            const std::string announced = std::to_string(faces_) + " faces announced, file ends after " + std::to_string(i);
            if (broken_line_ > 0) fail(broken_line_, "fewer corners than the face says (" + announced + ")", "correct its count");
            fail(counts_line_, announced, "the file may be cut off");
        }
        const std::optional<long long> corners = parse_integer(word);
        if (!corners || *corners < 0 || *corners > std::numeric_limits<int>::max())
            fail(line, "bad number of corners " + in_quotes(word), "a face is a count and that many vertex indices");
        for (long long k = 0; k < *corners; ++k) {
            const std::string_view corner = words_.next();
            if (words_.line() != line && broken_line_ == 0) broken_line_ = line;
            if (corner.empty())
                fail(broken_line_ > 0 ? broken_line_ : line, "face of " + std::to_string(*corners) + " corners has " + std::to_string(k),
                     "the file may be cut off");
            const std::optional<long long> index = parse_integer(corner);
            if (!index || *index < 0 || *index >= vertices_)
                fail(words_.line(),
                     "vertex index " + in_quotes(corner) + " is not a valid index (file has " + vertex_count(vertices_) + ")",
                     "indices are whole numbers from 0");
            polygons_.add_corner(static_cast<int>(*index));
        }
        polygons_.end_polygon(line);
        words_.skip_line();
    }

    std::size_t size_;
    WordScanner words_;
    const std::string& file_;
    std::string name_ = "OFF";
    int fewest_numbers_ = 3;   // on a vertex line
    long counts_line_ = 0;
    long broken_line_ = 0;   // the first face that continues on the next line
    long long vertices_ = 0, faces_ = 0;
    Positions X_;
    PolygonList polygons_;
    WarningTally warnings_;
};

}   // namespace

LoadedMesh parse_off(std::string_view text, const std::string& file, Keep) {
    // A binary OFF has NUL bytes behind a first line that says so, which is the better message.
    const std::string_view keyword_line = text.substr(0, text.find('\n'));
    if (keyword_line.find("BINARY") == std::string_view::npos) refuse_nul_bytes(text, file);
    return OffReader(without_bom(text), file).run();
}

}   // namespace meshfolio
