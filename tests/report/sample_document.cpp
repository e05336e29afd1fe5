#include "report/sample_document.h"

#include <cmath>

#include "report/test_tools.h"

namespace meshfolio::report {

namespace {

Table error_table() {
    Table table{"q1_errors",
                "Relative errors of H against the closed form.",
                {{"mesh"},
                 {"vertices", "", 6},
                 {"L2 error", "%", 3, Column::Best::smallest},
                 {"order", "", 2, Column::Best::largest},
                 {"H", "1/length", 4}},
                {}};
    table.columns[2].heat = {1, 100};
    table.rows = {{std::string("sphere"), 642.0, 0.88, 1.02, 1.0},
                  {std::string("torus"), 2048.0, 0.0352, 2.0, 1e-9},
                  {std::string("ellipsoid"), 10242.0, 28.1, Cell(), 123456789.0},
                  {std::string("plane"), 121.0, undefined, INFINITY, Cell()}};
    return table;
}

Table long_table() {
    Table table{"q1_long", "One row a vertex.", {{"vertex", "", 6}, {"value", "length", 5}}, {}};
    for (int i = 0; i < 450; ++i) table.rows.push_back({double(i), std::sin(0.01 * i)});
    return table;
}

/// Sorted and filtered by its readers; its first column refers to tables.
Table ledger() {
    Table table{"q1_ledger", "Two findings.", {{"no."}, {"verdict"}, {"number", "%"}}, {}};
    table.columns[0].reference = table.columns[1].filter = true;
    table.sortable = true;
    table.rows = {{std::string("q1_errors"), std::string("holds"), 0.25}, {std::string("q1_counts"), std::string("refuted"), Cell()}};
    return table;
}

/// A sortable table with numbers at the heads of its rows.
Table counts() {
    Table table{"q1_counts", "Two counts.", {{"k"}, {"share", "%"}}, {}};
    table.sortable = true;
    table.rows = {{5.0, 0.5}, {15.0, 0.75}};
    return table;
}

Plot error_plot() {
    Plot plot{"q1_error_versus_k",
              "Error against k with its minimum.",
              "The error falls from 8.5 % at k = 5 to 0.58 % at k = 150.",
              "number of eigenvectors k",
              "rms error [% of box diagonal]",
              true,
              true,
              {},
              {},
              {}};
    Series measured{"measured", {}, {}, {}, {}, Series::Style::line_and_points, 0, 0},
        predicted{"predicted (Parseval)", {}, {}, {}, {}, Series::Style::dashed};
    for (const double k : {1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 60.0, 150.0, 361.0}) {
        const double y = 18 / std::pow(k, 0.66);
        predicted.x.push_back(k);
        predicted.y.push_back(y);
        measured.x.push_back(k);
        measured.y.push_back(k == 30 ? undefined : y * 1.04);
        measured.y_low.push_back(0.8 * y);
        measured.y_high.push_back(1.25 * y);
    }
    plot.series = {measured, predicted};
    plot.markers = {{15, 18 / std::pow(15, 0.66), "3.5 % at k = 15"}, {150, 18 / std::pow(150, 0.66), "minimum"}};
    plot.vertical_lines = {{50, "k = n/7"}};
    return plot;
}

Map error_map() {
    Map map{"q1_error_map",
            "Error over step and iteration.",
            "The error grows with both; beyond λ_crit it is undefined from iteration 10 on.",
            "λ/λ_crit",
            "iteration",
            "error [% of box diagonal]",
            {0.1, 1, 10},
            {1, 10},
            true,
            true,
            true};
    map.undefined = "blew up";
    map.panels = {{"explicit", {0.1, 1, 10, 1, 8, undefined}, {{"λ_crit", {1, 1}, {1, 10}}}, {{0.1, 10, "a"}}},
                  {"implicit", {0.1, 0.9, 5, 0.9, 5, 7}}};
    return map;
}

/// The edge from i to j with the two angles opposite to it, and a vertex with its missing angle.
Diagram angle_diagram() {
    const DiagramPoint i{0, 0}, j{2, 0.4}, above{0.7, 1.5}, below{1.1, -1.4};
    Diagram::Panel cotangent{"cotangent weights", {}, {}};
    cotangent.paths = {path_through({i, below, j, above}, Diagram::Style::area, true),
                       path_through({i, below, j, above}, Diagram::Style::line, true), path_through({i, j}, Diagram::Style::accent),
                       angle_arc(above, i, j, 0.35, Diagram::Style::accent), angle_arc(below, i, j, 0.35, Diagram::Style::accent)};
    const DiagramPoint alpha = inside_angle(above, i, j, 0.6), beta = inside_angle(below, i, j, 0.6);
    cotangent.labels = {{i[0], i[1], {math("x_i")}, Diagram::Side::left, true},
                        {j[0], j[1], {math("x_j")}, Diagram::Side::right, true},
                        {alpha[0], alpha[1], {math("α_ij")}, Diagram::Side::centre, false, true},
                        {beta[0], beta[1], {math("β_ij")}, Diagram::Side::centre, false, true}};
    Diagram::Panel deficit{"angle deficit", {}, {}};
    const DiagramPoint left{-1, 1}, right{1, 1};
    deficit.paths = {path_through({i, right, left}, Diagram::Style::accent_area, true),
                     path_through({left, i, right}, Diagram::Style::dashed), path_through({i, {0, -1}}, Diagram::Style::line)};
    deficit.paths.back().arrow = true;
    deficit.labels = {{0, 0.7, text("gap ", math("2π − Σθ")), Diagram::Side::centre}, {0, -1, text("normal"), Diagram::Side::below_right}};
    return {"q1_angles", "Angles of *the* weights.", "An edge with the two angles opposite to it.", {cotangent, deficit}};
}

Section answered() {
    Section s;
    s.id = "q1";
    s.title = "Uniform Laplace curvature";
    s.asked = "Are they good approximations?";
    s.extent = "H and K on 4 meshes, errors on 3";
    s.inputs = {{"plane", "curvatures/plane.obj", "plane.obj", true, std::string(64, 'a'), 121, 200},
                {"sphere", "", "sphere.ply", false, std::string(64, 'b'), 40962, 81920}};
    s.parameters = {{"area form", "barycentric"}, {"clip", {"2 %", 0.02, "share"}}};
    s.code = {{"uniform_laplacian", "src/geometry/operators/uniform_laplacian.cpp", "Δ with uniform weights", 420},
              {"angle_deficit", "src/geometry/curvature/curvature.cpp", "cited, but not found in src.txt"}};
    s.blocks = {Heading{"Method"},
                Paragraph{text("Plain, ", strong("strong"), ", ", emphasis("emphasis"), ", ", code("answer_q1"), ", ",
                               math("λ_crit = 2/μ_max, x^{2}, Δx"), "; see ", ref("q1_eq"), ", ", ref("q1_plane_h"), ", ", ref("q1_errors"),
                               ", ", ref("q1_error_versus_k"), ", ", ref("q1_error_map"), ", ", ref("q2"), ", ", ref("q2_anything"), ", ",
                               ref("q9"), " and ", ref("desbrun_1999"), ".")},
                BulletList{{text("one"), text("two, ", math("h^−2"))}},
                Formula{"uniform_laplacian", "q1_eq"},
                Formula{"ellipsoid_EFG", ""},
                Heading{"Results"},
                Figure{"q1_plane_h", "Mean curvature of the plane.", "A plane from six directions, values from 0 to 1."},
                Figure{"q1_missing", "A figure without a picture.", "Nothing."},
                error_table(),
                error_plot(),
                long_table(),
                error_map(),
                ledger(),
                counts(),
                Figure{"q1_before_after", "Before and after.", "A plane before and after, which moved by 1 %."},
                angle_diagram()};
    s.checks = {check_near("Gauss–Bonnet: Σ deficit / 2π on sphere", 2, 2 + 1e-13, 1e-10),
                check_at_most("L2 error of H on sphere", 0.01, 0.0088),
                check_at_least("order of convergence on torus", 1.9, 0.7, 0, "too coarse"), check_near("undefined", 1, undefined, 0.1),
                undecided(check_at_most("count below σ", 30, undefined), "rounding is larger than the gap")};
    s.answer = text("H of the sphere is ", strong("0.88 %"), " off, ", emphasis("not"), " more, with ", code("A"), " and ",
                    math("λ_crit = x^{2}"), " (", ref("q1_errors"), ").");
    s.warnings = {"plane.obj: 3 duplicate faces were left out"};
    s.output_meshes = {"meshes/q1_plane.ply"};
    s.timings = {{"Laplacian", 0.0123}, {"curvature", 1.5}};
    return s;
}

}   // namespace

Document sample_document() {
    Document document;
    document.title = "Curvature and smoothing";
    document.author = "A. Student";
    document.course = "Acquisition and Processing of 3D Geometry";
    document.provenance = {"0.1.0", "1a2b3c4", "GCC 12.2.0", "Release", {{"Eigen", "3.4.0"}}, {{"size", "512"}}, 18446744073709551615ull};
    Section failed;
    failed.id = "q2";
    failed.title = "Fundamental forms";
    failed.status = Status::failed;
    failed.failure = "ellipsoid.obj:3: not a number";
    failed.checks = {check_near("all well", 1, 1, 0)};
    Section skipped;
    skipped.id = "q3";
    skipped.title = "Cotangent curvature";
    skipped.status = Status::skipped;
    skipped.extent = "stopped, because another question had failed";
    Section appendix;
    appendix.id = "ground_truth";
    appendix.title = "Ground truth";
    document.sections = {answered(), failed, skipped, appendix};
    document.timings = {{"everything", 12.3}};
    return document;
}

namespace {

DrawnPicture picture(std::string view, int left, int width, int height, std::string file, const std::string& bytes) {
    return {std::move(view), left, 40, width, height, std::move(file), std::string("\xff\xd8\xff\0", 4) + bytes};
}

/// Seen from three quarters and along six axes, the latter as files of their own.
DrawnPanel panel_with_views(const std::string& label, const std::string& name) {
    DrawnPanel panel{label, {picture("", 20, 480, 400, "", name + " large")}};
    for (const char* view : {"+x", "+y", "+z", "-x", "-y", "-z"})
        panel.pictures.push_back(picture(view, 600, 300, 200, "images/" + name + "_" + view + ".png", name + view));
    return panel;
}

}   // namespace

DrawnFigures sample_figures() {
    DrawnFigure drawn{.sheet = "images/q1_plane_h_sheet.png", .in_a_line = 2};
    drawn.panels = {panel_with_views("λ = 0.1", "q1_plane_h"), panel_with_views("λ = 1", "q1_plane_k")};
    drawn.legend = Legend{"mean curvature H", "1/length", -2, 3, {"#004c9e", "#eeeeee", "#93232b"}, 0.02, 0, "#e1bee7", {0.25, 0.75}};
    DrawnFigure compared{.sheet = "images/q1_before_after_sheet.png", .in_a_line = 3};
    for (const char* panel : {"before", "after", "moved"}) compared.panels.push_back({panel, {picture("", 20, 560, 500, "", panel)}});
    return {{"q1_plane_h", drawn}, {"q1_before_after", compared}};
}

DrawnFigures sample_layouts() {
    DrawnFigures figures = sample_figures();
    figures["q1_plane_h"].panels.resize(1);
    DrawnFigure& matrix = figures["q1_before_after"];
    matrix.in_a_line = 2;
    matrix.columns = {"explicit", "implicit"};
    matrix.rows = {"λ = 0.1", "λ = 1"};
    matrix.panels.push_back({"blew up", {}});
    return figures;
}

DrawnFigures sample_models() {
    DrawnFigures figures = sample_figures();
    figures["q1_plane_h"].models = {{"before", "models/q1_plane.glb", std::string("glTF\0one", 8), "H [1/length]"},
                                    {"", "models/λ = 1.glb", std::string("glTF\0two", 8), ""}};
    return figures;
}

const std::string hostile =
    "<script>alert(1)</script>|\"'`*_x_*](y)$&amp;\\ \xff\xc0\x80 \x1b[31m\x01\r\n\t# {{title}} ]]> \xEF\xBF\xBF \u202E --> é∞";

Document hostile_document() {
    Document d = sample_document();
    d.title = d.author = d.course = hostile;
    d.provenance = {hostile, hostile, hostile, hostile, {{hostile, hostile}}, {{hostile, hostile}}, 0};
    Section& s = d.sections[0];
    s.title = s.asked = s.extent = hostile;
    s.inputs[0] = {hostile, hostile, hostile, true, hostile, 1, 1};
    s.parameters = {{hostile, hostile}};
    s.code = {{hostile, hostile, hostile}};
    s.warnings = {hostile};
    s.output_meshes = {"meshes/" + hostile};
    s.timings = d.timings = {{hostile, 1}};
    for (Check& check : s.checks) check.name = check.note = hostile;
    s.answer = text(hostile, strong(hostile));
    s.blocks.push_back(Heading{hostile});
    s.blocks.push_back(Paragraph{text(hostile, strong(hostile), emphasis(hostile), code(hostile), math(hostile))});
    s.blocks.push_back(BulletList{{text(hostile)}});
    s.blocks.push_back(Figure{"q1_hostile", hostile, hostile});
    Map map = error_map();
    map.id = "q1_hostile_map";
    map.caption = map.alt = map.x_label = map.y_label = map.value_label = map.undefined = map.panels[0].title = hostile;
    map.panels[0].lines[0].name = map.panels[0].markers[0].label = hostile;
    s.blocks.emplace_back(map);
    Diagram diagram = angle_diagram();
    diagram.id = "q1_hostile_diagram";
    diagram.caption = diagram.alt = diagram.panels[0].title = hostile;
    diagram.panels[0].labels[0].words = text(hostile, math(hostile));
    s.blocks.emplace_back(diagram);
    Table table{"q1_hostile_table", hostile, {{hostile, hostile}, {"x", "", 3}}, {{hostile, 1.0}}};
    table.sortable = table.columns[0].filter = true;
    s.blocks.push_back(table);
    s.blocks.push_back(Plot{"q1_hostile_plot",
                            hostile,
                            hostile,
                            hostile,
                            hostile,
                            false,
                            false,
                            {{hostile, {1, 2}, {1, 2}, {}, {}}},
                            {{1, 1, hostile}},
                            {{1.5, hostile}}});
    d.sections[1].failure = hostile;
    return d;
}

DrawnFigures hostile_figures() {
    DrawnFigures drawn = sample_figures();
    DrawnFigure& figure = drawn["q1_hostile"];
    figure = {.sheet = "images/" + hostile, .columns = {hostile, hostile}, .rows = {hostile}, .in_a_line = 2};
    figure.panels = {{hostile, {{hostile, 0, 0, 1, 1, "images/" + hostile, ""}}}, {hostile, {}}};
    figure.legend = Legend{hostile, hostile, 0, 1, {hostile}, 1, 1, hostile, {1}, true};
    return drawn;
}

}   // namespace meshfolio::report
