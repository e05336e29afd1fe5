#include "geometry/operators/vertices_with_mass.h"

#include "base/at.h"
#include "base/errors.h"
#include "base/number_text.h"

namespace meshfolio {
namespace {

void check_masses(const LaplaceBeltrami& laplacian) {
    const auto& [C, M, copies] = laplacian;
    if (C.rows() != C.cols() || C.rows() != M.size())
        throw MeshError("C has " + std::to_string(C.rows()) + " rows and " + std::to_string(C.cols()) + " columns for " +
                            std::to_string(M.size()) + " masses",
                        "take C and M of one mesh");
    for (Eigen::Index i = 0; i < M.size(); ++i) {
        if (std::isfinite(M[i]) && M[i] >= 0) continue;
        throw MeshError("vertex " + std::to_string(i) + " has area " + plain_text(M[i], 3) + ", but areas must be finite and not negative",
                        "use barycentric or mixed areas");
    }
    if (!(M.maxCoeff() > 0))
        throw MeshError("no triangle has an area that can be told from 0", "scale the mesh up, or repair its triangles");
}

}   // namespace

OperatorWithMass operator_with_mass(const LaplaceBeltrami& laplacian) {
    if (laplacian.M.size() == 0) throw MeshError("an operator needs a mesh with vertices, this one has none", "take another mesh");
    check_masses(laplacian);
    const SparseMatrix& C = laplacian.C;
    const Vector M = summed_at_first(laplacian.copies, laplacian.M);
    OperatorWithMass reduced;
    reduced.all_vertices = static_cast<int>(M.size());
    reduced.copies = laplacian.copies;
    std::vector<int> row(static_cast<std::size_t>(M.size()), -1);
    for (int v = 0; v < reduced.all_vertices; ++v) {
        if (!(M[v] > 0)) continue;
        row[at(v)] = reduced.size();
        reduced.vertex.push_back(v);
    }
    reduced.M = M(reduced.vertex);

    const int n = reduced.size();
    reduced.A.resize(n, n);
    reduced.A.reserve(C.nonZeros());
    for (int j = 0; j < n; ++j) {
        reduced.A.startVec(j);
        double to_massless = 0;   // weight of edges that go with the vertices dropped
        for (SparseMatrix::InnerIterator entry(C, reduced.vertex[at(j)]); entry; ++entry)
            if (row[std::size_t(entry.row())] < 0) to_massless += entry.value();
        for (SparseMatrix::InnerIterator entry(C, reduced.vertex[at(j)]); entry; ++entry) {
            const int i = row[std::size_t(entry.row())];
            if (i >= 0) reduced.A.insertBack(i, j) = -(i == j ? entry.value() + to_massless : entry.value());
        }
    }
    reduced.A.finalize();
    return reduced;
}

DenseMatrix to_all_vertices(const OperatorWithMass& reduced, const DenseMatrix& rows) {
    DenseMatrix all = DenseMatrix::Zero(reduced.all_vertices, rows.cols());
    for (Eigen::Index c = 0; c < rows.cols(); ++c)
        for (int i = 0; i < reduced.size(); ++i) all(reduced.vertex[at(i)], c) = rows(i, c);
    spread(reduced.copies, all);
    return all;
}

Components components_of(const SparseMatrix& A) {
    Components components;
    components.label.assign(static_cast<std::size_t>(A.cols()), -1);
    std::vector<int> open;
    for (int seed = 0; seed < A.cols(); ++seed) {
        if (components.label[at(seed)] >= 0) continue;
        components.label[at(seed)] = components.count;
        open.push_back(seed);
        while (!open.empty()) {
            const int j = open.back();
            open.pop_back();
            for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) {
                int& label = components.label[std::size_t(entry.row())];
                if (entry.value() == 0 || label >= 0) continue;
                label = components.count;
                open.push_back(static_cast<int>(entry.row()));
            }
        }
        ++components.count;
    }
    return components;
}

SparseMatrix symmetric_form(const SparseMatrix& A, const Vector& M) {
    const Vector scale = M.cwiseSqrt().cwiseInverse();
    SparseMatrix B = A;   // NOLINT(performance-unnecessary-copy-initialization): its iterators write to it
    for (int j = 0; j < B.cols(); ++j)
        for (SparseMatrix::InnerIterator entry(B, j); entry; ++entry) entry.valueRef() *= scale[entry.row()] * scale[j];
    return B;
}

Eigen::Index first_largest(const Vector& y) {
    const double almost_largest = (1 - 1e-6) * y.cwiseAbs().maxCoeff();
    Eigen::Index i = 0;
    while (std::abs(y[i]) < almost_largest) ++i;
    return i;
}

SparseMatrix weighted_by_rows(SparseMatrix A, const Vector& weights) {   // NOLINT(performance-unnecessary-value-param): as above
    for (int j = 0; j < A.cols(); ++j)
        for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) entry.valueRef() *= weights[entry.row()];
    return A;
}

}   // namespace meshfolio
