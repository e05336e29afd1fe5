// CGAL's bounded-error Hausdorff distance of two PLY files: prints the distance that it found, its upper bound and seconds.
//   hausdorff_peer A.ply B.ply ERROR [length]
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/PLY.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>

using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

int main(int count, char** words) {
    Mesh a, b;
    std::ifstream file_a(count == 4 ? words[1] : "", std::ios::binary), file_b(count == 4 ? words[2] : "", std::ios::binary);
    if (!CGAL::IO::read_PLY(file_a, a) || !CGAL::IO::read_PLY(file_b, b)) return 2;
    const double error = std::atof(words[3]);
    const auto start = std::chrono::steady_clock::now();
    const double found =
        CGAL::Polygon_mesh_processing::bounded_error_symmetric_Hausdorff_distance<CGAL::Parallel_if_available_tag>(a, b, error);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::printf("%.17g %.17g %.6f\n", found, found + error, seconds.count());
}
