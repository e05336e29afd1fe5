// A corpus of hostile and odd meshes outside of the project, in the folder that MESHFOLIO_BAD_MESHES names. A table says for each file
// whether it must be refused (and at which line), accepted with a warning, or accepted silently, and gives its counts.
#include <gtest/gtest.h>

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/number_text.h"
#include "mesh/mesh_checks.h"
#include "source_dir.h"

using namespace meshfolio;
namespace fs = std::filesystem;

namespace {

fs::path corpus_folder() {
    const char* folder = std::getenv("MESHFOLIO_BAD_MESHES");
    return folder != nullptr ? folder : "";
}
const fs::path corpus = corpus_folder();

struct Row {
    std::string file, wrong, kind, says, line, expect, firmness;
};

std::string percent_decoded(const std::string& text) {
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            decoded += text[i];
            continue;
        }
        int byte = 0;
        std::from_chars(text.data() + i + 1, text.data() + i + 3, byte, 16);
        decoded += static_cast<char>(byte);
        i += 2;
    }
    return decoded;
}

std::vector<Row> rows() {
    std::istringstream manifest(read_file(corpus / "manifest.tsv"));
    std::string line;
    std::getline(manifest, line);
    std::vector<Row> all;
    while (std::getline(manifest, line)) {
        std::vector<std::string> cells{""};
        for (const char c : line) {
            if (c == '\t') {
                cells.emplace_back();
            } else {
                cells.back() += c;
            }
        }
        if (cells.size() == 7) all.push_back({percent_decoded(cells[0]), cells[1], cells[2], cells[3], cells[4], cells[5], cells[6]});
    }
    return all;
}

struct Outcome {
    std::string kind;
    std::string said;   // the message, or the warnings
    Preflight facts;
};

Outcome outcome_of(const fs::path& path) {
    try {
        const PreparedMesh mesh = prepare_mesh(read_mesh(path));
        Outcome outcome{mesh.warnings.empty() ? "accept" : "repair", "", mesh.preflight};
        for (const MeshWarning& w : mesh.warnings) outcome.said += mesh.file + ":" + std::to_string(w.line) + ": " + w.message + "\n";
        EXPECT_LE(mesh.warnings.size(), 20U) << path;
        return outcome;
    } catch (const InputError& error) {
        return {"reject", error.what(), {}};
    }
}

void expect_facts(const Row& row, const Preflight& p) {
    const std::map<std::string, double> facts{{"V", p.vertices_in_use}, {"F", p.triangles},           {"chi", p.euler_characteristic},
                                              {"comps", p.components},  {"bedges", p.boundary_edges}, {"area", p.area}};
    std::istringstream expected(row.expect);
    for (std::string fact; expected >> fact;) {
        const std::size_t equals = fact.find('=');
        const double value = parse_number(fact.substr(equals + 1)).value();
        EXPECT_NEAR(facts.at(fact.substr(0, equals)), value, 1e-6 * std::abs(value)) << row.file << " " << fact;
    }
}

}   // namespace

TEST(BadMeshes, EveryRowOfTheTableHolds) {
    if (!fs::exists(corpus / "manifest.tsv")) GTEST_SKIP() << "MESHFOLIO_BAD_MESHES names no folder with a manifest.tsv";
    int checked = 0;
    for (const Row& row : rows()) {
        if (row.file.starts_with("special/")) continue;
        // The table is older than the support of strips and gzip.
        if (row.file == "ply/element_tristrips.ply" || row.file == "obj/packed.obj.gz") continue;
        const Outcome outcome = outcome_of(corpus / row.file);
        ++checked;
        const bool free_choice = row.firmness == "choice" && (outcome.kind != "accept" || row.kind == "accept");
        if (outcome.kind != row.kind) {
            EXPECT_TRUE(free_choice) << row.file << " is " << outcome.kind << ", should be " << row.kind << ": " << outcome.said;
            continue;
        }
        if (row.kind != "accept" && row.line != "-" && row.line != "*") {
            EXPECT_NE(outcome.said.find(":" + row.line + ": "), std::string::npos) << row.file << ": " << outcome.said;
        }
        if (row.kind != "reject") expect_facts(row, outcome.facts);
    }
    EXPECT_GT(checked, 200);
}
