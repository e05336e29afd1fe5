#include "geometry/smoothing/laplacian_smoothing.h"

#include <optional>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "base/number_text.h"
#include "geometry/measures/spatial_order.h"
#include "geometry/smoothing/diffusion_step.h"
#include "geometry/smoothing/limit_watch.h"
#include "geometry/spectrum/stability.h"
#include "mesh/triangle_kind.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {
namespace {

/// The units of a run: about the box centre, by a power of two near the box diagonal. Scaling is exact, and coordinates far from the origin
/// do not cost the differences between them their digits.
struct Frame {
    Eigen::RowVector3d centre{0, 0, 0};
    double unit = 1;       // [length]
    double diagonal = 0;   // of the box [unit]

    explicit Frame(const TriangleMesh& mesh) {
        const Box box = bounding_box(mesh);
        if (!(box.diagonal() > 0)) throw MeshError("smoothing: all vertices of the mesh lie at one point", "take another mesh");
        centre = box.centre().transpose();
        unit = std::exp2(std::ceil(std::log2(box.diagonal())));
        diagonal = box.diagonal() / unit;
    }
    Positions inside(const Positions& X) const { return (X.rowwise() - centre) / unit; }
};

void check(const SmoothingOptions& options) {
    if (!std::isfinite(options.lambda) || options.lambda <= 0)
        throw MeshError("smoothing: lambda = " + plain_text(options.lambda), "it must be positive and finite");
    if (options.iterations < 0) throw MeshError("smoothing: " + std::to_string(options.iterations) + " iterations", "give 0 or more");
    if (!(options.adaptive >= 0 && options.adaptive <= 1))
        throw MeshError("smoothing: adaptive = " + plain_text(options.adaptive),
                        "it is a share of the largest stable step, between 0 (off) and 1");
    if (options.scheme != SmoothingScheme::explicit_euler && (options.monitor || options.adaptive > 0)) {
        throw MeshError("smoothing: only explicit steps have a limit to keep",
                        "take the explicit scheme, or leave monitor and adaptive off");
    }
    if (!(options.blow_up_at > 0)) throw MeshError("smoothing: blow_up_at = " + plain_text(options.blow_up_at), "it must be positive");
    if (options.scheme == SmoothingScheme::taubin && !(std::isfinite(options.taubin_mu) && options.taubin_mu <= 0))
        throw MeshError("smoothing: Taubin's mu = " + plain_text(options.taubin_mu), "it must be negative, or 0 for the pass-band");
}

void check_rows(const OperatorWithMass& whole, const Positions& X) {
    if (X.rows() == whole.all_vertices) return;
    throw MeshError(
        "smoothing: " + std::to_string(X.rows()) + " positions for an operator on " + std::to_string(whole.all_vertices) + " vertices",
        "give one position a vertex");
}

/// A run in the units of the frame: one scheme, one operator at a time, and the positions of the vertices with mass as rows of its solver.
class Diffusion {
public:
    /// @param options  in the units of the frame; kept by reference, as `mesh` and `implicit`
    Diffusion(const TriangleMesh& mesh, const SmoothingOptions& options, const Frame& frame, ImplicitSolver& implicit)
        : mesh_(mesh), options_(options), frame_(frame), current_{frame.inside(mesh.X), mesh.F}, limit_(options), implicit_(implicit) {
        assemble();
    }

    /// Rebuilds the operator from the current positions. @return false if no more is left of the surface than the rounding of positions:
    /// if it shrank to a point (by 10⁻¹² in length) or a line, or all triangles have no area
    bool rebuild() {
        scatter(X_, vertex(), current_.X);
        spread(copies_, current_.X);
        const double area = surface_area(current_), diagonal = bounding_box(current_).diagonal();
        if (!(area > 1e-24 * area_ && area > 1e-12 * diagonal * diagonal)) return false;
        int t = 0;
        while (t < current_.face_count() && kind_of(current_, t) == TriangleKind::zero_area) ++t;
        if (t == current_.face_count()) return false;
        assemble();
        return true;
    }

    /// Makes one step, not accepted yet. @return the first vertex that is not finite, else the farthest one out of bounds; −1: none
    int step() {
        const double limit = options_.blow_up_at * frame_.diagonal;
        // Bounds of coordinates: then the distance is less than the limit, and its square finite.
        if (advance(std::min(limit / 2, 1e153))) return -1;
        int farthest = -1, not_finite = -1;
        double largest = limit * limit;
        for (Eigen::Index i = 0; i < next_.rows(); ++i) {
            const int v = vertex()[std::size_t(i)];
            const double distance = next_.row(i).head<3>().squaredNorm();
            if (!std::isfinite(distance)) {
                if (not_finite < 0 || v < not_finite) not_finite = v;
            } else if (distance > largest || (distance == largest && v < farthest)) {
                largest = distance;
                farthest = v;
            }
        }
        return not_finite >= 0 ? not_finite : farthest;
    }
    bool step_is_finite() const { return (next_ * frame_.unit).allFinite(); }
    void accept() { X_.swap(next_); }

    /// Returns the diffusion time of one step.
    double time_step() const {
        if (options_.scheme == SmoothingScheme::taubin) return options_.lambda + taubin_mu_;
        return options_.scheme == SmoothingScheme::explicit_euler ? limit_.lambda() : options_.lambda;
    }
    const LimitWatch& limit() const { return limit_; }
    double taubin_mu() const { return taubin_mu_; }

    /// Returns the positions of the whole mesh in its own units.
    Positions positions() const {
        Positions all = mesh_.X;
        for (std::size_t i = 0; i < vertex().size(); ++i)
            all.row(vertex()[i]) = X_.row(static_cast<Eigen::Index>(i)).head<3>() * frame_.unit + frame_.centre;
        spread(copies_, all);
        return all;
    }

private:
    void assemble() {
        const LaplaceBeltrami laplacian = laplace_operator(current_, options_.laplacian, options_.area);
        const OperatorWithMass whole = operator_with_mass(laplacian);
        copies_ = whole.copies;
        if (options_.scheme == SmoothingScheme::taubin && taubin_mu_ == 0) taubin_mu_ = taubin_mu_of(laplacian, options_);
        if (options_.scheme == SmoothingScheme::implicit_euler) {
            implicit_.prepare(whole, options_.lambda, options_.memory_limit, options_.factor_remotely);
        } else {
            if (order_.size() != whole.vertex.size()) order_ = morton_order(current_.X(whole.vertex, Eigen::all));
            explicit_.emplace(reordered(whole, order_));
            limit_.look(whole);
        }
        X_ = gathered(current_.X, vertex());
        next_.resize(X_.rows(), 4);
        between_.resize(options_.scheme == SmoothingScheme::taubin ? X_.rows() : 0, 4);
    }

    /// Computes the positions after the next step. @return true if all their coordinates are known to be finite and within ± `bound`
    bool advance(double bound) {
        switch (options_.scheme) {
            case SmoothingScheme::implicit_euler:
                next_ = X_;
                implicit_.step(next_);
                return false;
            case SmoothingScheme::taubin:
                explicit_->step(options_.lambda, X_, between_);
                return explicit_->step(taubin_mu_, between_, next_, bound);
            case SmoothingScheme::explicit_euler: break;
        }
        return explicit_->step(limit_.lambda(), X_, next_, bound);
    }

    /// Returns the vertex of each row of the positions of the solver in use.
    const std::vector<int>& vertex() const { return explicit_ ? explicit_->vertex() : implicit_.vertex(); }

    const TriangleMesh& mesh_;
    const SmoothingOptions& options_;
    Frame frame_;
    TriangleMesh current_;   // the mesh of the current operator
    const double area_ = surface_area(current_);
    std::vector<VertexCopy> copies_;
    LimitWatch limit_;
    ImplicitSolver& implicit_;
    double taubin_mu_ = 0;
    std::vector<int> order_;   // rows of explicit steps in spatial order: neighbours are near each other in memory
    std::optional<ExplicitDiffusion> explicit_;
    FourColumns X_, next_, between_;   // between_: after the first of Taubin's two steps
};

}   // namespace

SmoothingScheme smoothing_scheme_named(const std::string& name) {
    if (name == "explicit") return SmoothingScheme::explicit_euler;
    if (name == "implicit") return SmoothingScheme::implicit_euler;
    if (name == "taubin") return SmoothingScheme::taubin;
    throw UsageError("unknown smoothing scheme '" + printable(name) + "'",
                     suggestion(name, {"explicit", "implicit", "taubin"}) + "use explicit, implicit or taubin");
}

Smoothed smooth(const TriangleMesh& mesh, const SmoothingOptions& options) {
    ImplicitSolver solver;
    return smooth(mesh, options, solver);
}

Smoothed smooth(const TriangleMesh& mesh, const SmoothingOptions& options, ImplicitSolver& solver) {
    check(options);
    const Frame frame(mesh);
    const double step_unit = is_dimensionless(options.laplacian) ? 1 : frame.unit * frame.unit;   // of λ
    SmoothingOptions inside = options;
    inside.lambda /= step_unit;
    inside.taubin_mu /= step_unit;
    const SolverWork before = solver.work();
    Diffusion diffusion(mesh, inside, frame, solver);
    const bool rebuild = options.rebuild && options.laplacian != OperatorKind::uniform;   // the uniform operator ignores positions
    Smoothed result;
    for (int t = 1; t <= options.iterations && !result.blew_up; ++t) {
        if (rebuild && t > 1 && !diffusion.rebuild()) {
            result.collapse_iteration = t;
            break;
        }
        if (diffusion.limit().watching()) {
            result.steps.push_back(diffusion.limit().step());
            result.steps.back().lambda *= step_unit;
            if (result.crossing_iteration == 0 && result.steps.back().top > 2) {
                result.crossing_iteration = t;
                result.crossing_vertex = result.steps.back().vertex;
            }
        }
        result.blow_up_vertex = diffusion.step();
        result.blew_up = result.blow_up_vertex >= 0;
        if (result.blew_up) result.blow_up_iteration = t;
        if (result.blew_up && !diffusion.step_is_finite()) break;
        diffusion.accept();
        result.iterations = t;
        result.time += diffusion.time_step() * step_unit;
        if (options.after_step && !options.after_step(t, diffusion.positions())) break;
    }
    result.X = result.iterations > 0 ? diffusion.positions() : mesh.X;
    result.taubin_mu = diffusion.taubin_mu() * step_unit;
    if (options.scheme != SmoothingScheme::implicit_euler) return result;
    result.solver = solver.solver();
    result.factor_nonzeros = solver.factor_nonzeros();
    result.analyses = solver.work().analyses - before.analyses;
    result.factorisations = solver.work().factorisations - before.factorisations;
    result.solver_iterations = solver.work().iterations - before.iterations;
    return result;
}

double taubin_mu_of(const LaplaceBeltrami& laplacian, const SmoothingOptions& options) {
    if (options.taubin_mu != 0) return options.taubin_mu;
    const double inverse = 0.5 * options.pass_band * largest_eigenvalue(laplacian).value - 1 / options.lambda;
    if (inverse < 0) return 1 / inverse;
    throw MeshError("smoothing: no Taubin step inflates again after lambda at pass-band " + plain_text(options.pass_band, 3),
                    "take a smaller lambda");
}

// f(μ) = (1 − λμ)(1 − mμ) with m < 0 is largest at μ = (1/λ + 1/m)/2, half the pass-band; |f| there or at the end of the spectrum.
TaubinGrowth taubin_growth(const LaplaceBeltrami& laplacian, const SmoothingOptions& options) {
    const double lambda = options.lambda, m = taubin_mu_of(laplacian, options), top = largest_eigenvalue(laplacian).value;
    const auto factor = [&](double mu) { return std::abs((1 - lambda * mu) * (1 - m * mu)); };
    const double middle = std::clamp(0.5 * (1 / lambda + 1 / m), 0.0, top);
    return factor(top) > factor(middle) ? TaubinGrowth{factor(top), top, true} : TaubinGrowth{factor(middle), middle, false};
}

std::string TaubinGrowth::warning(int iterations) const {
    constexpr double material = 1.2;
    if (of_highest_mode) return factor > 1 ? "each iteration multiplies the highest mode by " + plain_text(factor, 4) : "";
    const double in_all = std::pow(factor, iterations);
    if (!(in_all > material)) return "";
    return "each iteration multiplies modes near mu = " + plain_text(mu, 3) + ", where the mesh has any, by up to " +
           plain_text(factor, 6) + ", all " + std::to_string(iterations) + " by " + plain_text(in_all, 3) + ": the surface may swell";
}

Positions explicit_step(const LaplaceBeltrami& laplacian, double lambda, const Positions& X) {
    const OperatorWithMass whole = operator_with_mass(laplacian);
    check_rows(whole, X);
    const Eigen::RowVector3d near = X.row(whole.vertex.front());
    return ExplicitDiffusion(whole).step(lambda, X.rowwise() - near).rowwise() + near;
}

Positions implicit_step(const LaplaceBeltrami& laplacian, double lambda, const Positions& X) {
    const OperatorWithMass whole = operator_with_mass(laplacian);
    check_rows(whole, X);
    const Eigen::RowVector3d near = X.row(whole.vertex.front());
    ImplicitSolver solver;
    solver.prepare(whole, lambda);
    return solver.step(X.rowwise() - near).rowwise() + near;
}

}   // namespace meshfolio
