// Options that several commands have in common.
#include "cli/commands.h"
#include "run/arguments.h"
#include "run/settings/report_settings.h"

namespace meshfolio::cli {

void add_paper_options(CommandOptions& app, ReportFlags& flags) {
    app.text("--title WORDS", flags.title, "title of the report; default: that of the settings, for own meshes their names");
    app.text("--course NAME", flags.course, "course that the report is for; default: that of the settings, for own meshes none");
    app.text("--author NAME", flags.author, "author of the work");
    app.text("--config SETTINGS", flags.config,
             "settings file (TOML; data/report.toml documents every key), else the bundled settings of that name");
    app.text("--templates DIR", flags.templates, "folder of templates that replace those of the same name; links may not lead out of it");
    app.flag("--no-source", flags.no_source, "without src.txt, the source of the program; default for own meshes and in batch");
    app.text("--pdf auto|require|off", flags.pdf,
             "report.pdf and appendix.pdf: auto, where an engine is there (the default of report); require; or off");
    app.text("--pdf-browser FILE", flags.pdf_browser, "the browser that prints, by name or path; default: the first that is found");
}

void add_sight_options(CommandOptions& app, SightFlags& flags) {
    app.text("--camera AZ,EL[,ROLL]", flags.camera,
             "place of the camera [degrees]: from the front of the model to its right, and upwards; default: where most is seen");
    app.text("--up x|y|z", flags.up, "axis of the model that points up; default: y for a camera, else found for each mesh");
    app.text("--zoom", flags.zoom, "factor of the size in the picture; default: 1");
}

void add_run_options(CommandOptions& app, ReportFlags& flags) {
    app.text("--only QUESTIONS", flags.only,
             "some of the questions: q1,q4 or 1-3,7; the others stay if --out has a report of the same inputs and settings");
    app.text("--time SECONDS", flags.time,
             "seconds on two cores to fit into: settings are made small, large meshes decimated; default: 180 up to 346,000 triangles, "
             "then in proportion");
    app.text("--size PIXELS", flags.size, "pixels of one view; default: 800, or 400 with --quick");
    add_sight_options(app, flags);
    app.text("--threads", flags.threads, "largest number of threads, in a batch of all reports together; default: all");
    app.flag("--views-files", flags.view_files, "every view of every figure as a PNG of that size, not only those asked to be handed in");
    app.flag("--no-timings", flags.no_timings, "leave out everything that differs from run to run");
    app.flag("--no-cache", flags.no_cache, "answer every question anew and keep no answer; see meshfolio cache --help");
}

}   // namespace meshfolio::cli
