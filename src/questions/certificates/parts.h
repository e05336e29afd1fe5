/// @file
/// The parts of the certificates.
#pragma once

#include "questions/certificates/planted_faults.h"

namespace meshfolio::certificates {

inline constexpr report::Words words("certificates");

/// One mesh with its operator, its smallest modes and what was measured on them.
struct Certified {
    std::shared_ptr<const LibraryMesh> source;
    LaplaceBeltrami laplacian;
    Vector angle_deficits;   // [rad]
    int without_area = 0;    // triangles
    SpectrumCertificate certificate;
    int modes = 0;

    const std::string& name() const { return source->name; }
    const TriangleMesh& mesh() const { return source->mesh(); }
    SurfaceClaims claims() const {
        const Preflight& p = source->prepared->preflight;
        return {p.manifold(), p.orientable, p.closed(), p.euler_characteristic};
    }
};

report::Table spectrum_table(const std::vector<Certified>& meshes);
report::Table operator_table(const std::vector<Certified>& meshes);
report::Table fault_table(const std::vector<FaultTrial>& trials);

}   // namespace meshfolio::certificates
