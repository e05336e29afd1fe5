#include <memory>

#include "cli/commands.h"
#include "run/mark/mark_class.h"

namespace meshfolio::cli {

Command mark_command(CLI::App& parent) {
    const auto flags = std::make_shared<MarkFlags>();
    flags->out = "marks";
    CommandOptions app(parent, "mark", "Students' meshes and numbers compared with the right answers");
    app.required_texts("SUBMISSION", flags->submissions, "a student's folder or zip; several for a class");
    app.text(
        "--rubric FILE", flags->rubric,
        "the items to mark (TOML, perhaps in one file with the settings of the sheet), or bundled settings by name; default: the bundled "
        "data/rubric.toml, which documents every key");
    app.text("--out DIR", flags->out, "folder of the marks, replaced as a whole; all its students must be marked again");
    app.text("--templates DIR", flags->templates, "folder of templates that replace those of the same name");
    app.footer(
        "Writes class.csv, and for each student a page that shows the differences on the mesh, and results.json as Gradescope reads it.\n"
        "Nothing of a submission is executed. A submission that cannot be read (a zip bomb, a path that leads outside, a link) is refused "
        "by\n"
        "name, the others are marked, and the exit code is 1.\n"
        "Example: meshfolio mark class/*.zip --rubric rubric.toml --out marks");
    return {app, [flags] { return mark_class(*flags); }};
}

}   // namespace meshfolio::cli
