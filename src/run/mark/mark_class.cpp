#include "run/mark/mark_class.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>

#include "base/file_bytes.h"
#include "base/in_quotes.h"
#include "output/publish/folder_system.h"
#include "output/publish/publish.h"
#include "report/words.h"
#include "run/console.h"
#include "run/mark/mark_pages.h"
#include "run/progress.h"

namespace meshfolio::run {

namespace fs = std::filesystem;

namespace {

void require_submissions(const std::vector<std::string>& submissions) {
    for (const std::string& path : submissions)
        if (!may_be_there(path)) throw InputError({path}, "is not there", near_names(path));
}

/// The name of the folder or zip where it is a safe one, else made so; one that another has gets a number.
std::string id_of(const fs::path& submission, std::set<std::string>& taken) {
    const fs::path named = submission.has_filename() ? submission : submission.parent_path();
    const std::string whole = fs::absolute(named).lexically_normal().filename().string();
    const bool is_zip = fs::path(whole).extension() == ".zip";
    const std::string stem = is_zip ? fs::path(whole).stem().string() : whole;
    const std::string name = output::is_safe_name(stem) ? stem : short_name(stem);
    std::string id = name;
    for (int number = 2; !taken.insert(id).second; ++number) id = name + "-" + std::to_string(number);
    return id;
}

/// A name of its own for each.
std::vector<std::string> ids_of(const std::vector<std::string>& submissions) {
    std::set<std::string> taken{"class.csv", "class.html", output::sums_file};
    std::vector<std::string> ids;
    std::ranges::transform(submissions, std::back_inserter(ids), [&](const std::string& path) { return id_of(path, taken); });
    return ids;
}

/// The marks of an earlier run are replaced as a whole: by those of the same students at least.
void require_nobody_lost(const fs::path& out, const std::vector<std::string>& ids) {
    for (const std::string& file : output::sums_of(out).paths) {
        const std::size_t slash = file.find('/');
        const std::string student = file.substr(0, slash);
        if (slash != std::string::npos && std::ranges::find(ids, student) == ids.end() && may_be_there(out / file))
            throw OutputError(out.string(), "holds the marks of " + in_quotes(student) + ", who is not among these submissions",
                              "name the whole class, or choose another folder with --out");
    }
}

/// Right answers at the settings of the rubric: what is wrong with them is wrong with the rubric.
void compute_references(const Rubric& rubric, References& references) {
    for (const RubricItem& item : rubric.items) {
        if (references.of(item, item.settings).not_unique)
            warn(item.id + ": k = " + std::to_string(item.settings.k) +
                 " parts equal eigenvalues; other reconstructions are right as well");
    }
}

StudentMarks marks_of_submission(const std::string& path, const Rubric& rubric, References& references) {
    try {
        return marks_of(submission::read_handed_in(path), rubric, references);
    } catch (const InputError& error) {
        StudentMarks refused;
        refused.refused = error.what();
        complain(error.what());
        return refused;
    }
}

void write_student(const StudentMarks& marks, const Rubric& rubric, const report::Templates& templates, const fs::path& folder) {
    output::make_folder(folder);
    write_file(folder / "index.html", student_page(marks, rubric, templates));
    write_file(folder / "results.json", student_json(marks, rubric));
}

}   // namespace

ExitCode mark_class(const MarkFlags& flags) {
    const Rubric rubric = read_rubric(flags.rubric);
    const report::Templates templates(flags.templates);
    report::use_words_of(templates);
    require_submissions(flags.submissions);
    const std::vector<std::string> ids = ids_of(flags.submissions);
    References references(rubric);
    output::Publication publication(flags.out, output::marks_folder);
    require_nobody_lost(flags.out, ids);
    compute_references(rubric, references);
    std::vector<StudentMarks> students;
    int refused = 0;
    Stage stage("marking");
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const std::string& path = flags.submissions[i];
        StudentMarks marks = marks_of_submission(path, rubric, references);
        marks.id = ids[i];
        marks.source = fs::path(path).filename().string();
        if (marks.source.empty()) marks.source = marks.id;
        refused += marks.refused.empty() ? 0 : 1;
        write_student(marks, rubric, templates, publication.folder() / marks.id);
        for (ItemMark& mark : marks.items) mark.difference = {};   // drawn, and as large as the mesh
        students.push_back(std::move(marks));
        stage.advance(static_cast<double>(students.size()) / static_cast<double>(ids.size()));
    }
    write_file(publication.folder() / "class.csv", class_csv(students, rubric));
    write_file(publication.folder() / "class.html", class_page(students, rubric, templates));
    tell_of(publication.publish({}, [&] { require_nobody_lost(flags.out, ids); }));   // another run may have come first
    complain(std::to_string(students.size() - static_cast<std::size_t>(refused)) + " marked, " + std::to_string(refused) + " refused");
    print_path(fs::path(flags.out) / "class.csv");
    return refused > 0 ? ExitCode::failed : ExitCode::ok;
}

}   // namespace meshfolio::run
