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

/// Returns a safe folder name for each submission: the name of the folder or zip, with a number if another has it.
std::vector<std::string> ids_of(const std::vector<std::string>& submissions) {
    std::set<std::string> taken{"class.csv", "class.html", output::sums_file};
    std::vector<std::string> ids;
    for (const fs::path submission : submissions) {
        const fs::path named = submission.has_filename() ? submission : submission.parent_path();
        const fs::path whole = fs::absolute(named).lexically_normal().filename();
        const std::string stem = (whole.extension() == ".zip" ? whole.stem() : whole).string();
        const std::string name = output::is_safe_name(stem) ? stem : short_name(stem);
        std::string id = name;
        for (int number = 2; !taken.insert(id).second; ++number) id = name + "-" + std::to_string(number);
        ids.push_back(id);
    }
    return ids;
}

/// Requires that every student with marks in `out`, which is replaced as a whole, is marked again.
void require_nobody_lost(const fs::path& out, const std::vector<std::string>& ids) {
    for (const std::string& file : output::sums_of(out).paths) {
        const std::size_t slash = file.find('/');
        const std::string student = file.substr(0, slash);
        if (slash != std::string::npos && std::ranges::find(ids, student) == ids.end() && may_be_there(out / file))
            throw OutputError(out.string(), "holds the marks of " + in_quotes(student) + ", who is not among these submissions",
                              "name the whole class, or choose another folder with --out");
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

}   // namespace

ExitCode mark_class(const MarkFlags& flags) {
    const Rubric rubric = read_rubric(flags.rubric);
    const report::Templates templates(flags.templates);
    report::use_words_of(templates);
    for (const std::string& path : flags.submissions)
        if (!may_be_there(path)) throw InputError({path}, "is not there", near_names(path));
    const std::vector<std::string> ids = ids_of(flags.submissions);
    References references(rubric);
    output::Publication publication(flags.out, output::marks_folder);
    require_nobody_lost(flags.out, ids);
    for (const RubricItem& item : rubric.items) {   // an error here is an error of the rubric, not of a student
        if (references.of(item, item.settings).not_unique)
            warn(item.id + ": k = " + std::to_string(item.settings.k) +
                 " parts equal eigenvalues; other reconstructions are right as well");
    }
    std::vector<StudentMarks> students;
    Stage stage("marking");
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const std::string& path = flags.submissions[i];
        StudentMarks marks = marks_of_submission(path, rubric, references);
        marks.id = ids[i];
        marks.source = fs::path(path).filename().string();
        if (marks.source.empty()) marks.source = marks.id;
        const fs::path folder = publication.folder() / marks.id;
        output::make_folder(folder);
        write_file(folder / "index.html", student_page(marks, rubric, templates));
        write_file(folder / "results.json", student_json(marks, rubric));
        for (ItemMark& mark : marks.items) mark.difference = {};   // drawn, and as large as the mesh
        students.push_back(std::move(marks));
        stage.advance(static_cast<double>(students.size()) / static_cast<double>(ids.size()));
    }
    write_file(publication.folder() / "class.csv", class_csv(students, rubric));
    write_file(publication.folder() / "class.html", class_page(students, rubric, templates));
    tell_of(publication.publish({}, [&] { require_nobody_lost(flags.out, ids); }));   // another run may have come first
    const auto refused = std::ranges::count_if(students, [](const StudentMarks& marks) { return !marks.refused.empty(); });
    complain(std::to_string(std::ssize(students) - refused) + " marked, " + std::to_string(refused) + " refused");
    print_path(fs::path(flags.out) / "class.csv");
    return refused > 0 ? ExitCode::failed : ExitCode::ok;
}

}   // namespace meshfolio::run
