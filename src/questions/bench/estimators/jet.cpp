// H and K of the cubic that fits two rings.
#include "geometry/curvature/jet_fit.h"

#include "questions/bench/estimators.h"

namespace meshfolio::estimates {

namespace {
const JetCurvature& jet(const BenchMesh& b) {
    return b.shared("jet", [&] { return jet_curvature(b.mesh, b.topology); });
}
}   // namespace

extern const Estimator H_jet{"H.jet", "jet", Quantity::H, [](const BenchMesh& b) { return jet(b).H; }};
extern const Estimator K_jet{"K.jet", "jet", Quantity::K, [](const BenchMesh& b) { return jet(b).K; }};

}   // namespace meshfolio::estimates
