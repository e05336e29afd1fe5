#include "questions/certificates/parts.h"

namespace meshfolio::certificates {

namespace {

report::Text about_spectra(const std::vector<Certified>& meshes) {
    Names proved, refuted, open;
    for (const Certified& mesh : meshes) {
        const Proof verdict = mesh.certificate.verdict();
        (verdict == Proof::proved ? proved : verdict == Proof::refuted ? refuted : open).push_back(mesh.name());
    }
    report::Text t;
    if (!proved.empty()) report::extend(t, words.say("proved", "meshes"_a = listed(proved)), " ");
    if (!refuted.empty()) report::extend(t, words.say("refuted", "meshes"_a = listed(refuted)), " ");
    if (!open.empty()) report::extend(t, words.say("open", "meshes"_a = listed(open)));
    return t;
}

report::Text about_faults(const std::vector<FaultTrial>& trials, const Specimen& specimen) {
    Names missed;
    int alone = 0;
    for (const FaultTrial& trial : trials) {
        if (!trial.caught()) missed.push_back("“" + trial.fault + "”");
        alone += trial.caught() && trial.also_seen_by.empty() ? 1 : 0;
    }
    const report::Text caught =
        missed.empty() ? words.say("planted.caught") : words.say("planted.missed", "missed"_a = listed(missed), "number"_a = missed.size());
    report::Text t =
        words.say("planted", "faults"_a = trials.size(), "modes"_a = specimen.spectrum.eigenvalues.size(), "caught"_a = caught);
    if (alone > 0) report::extend(t, " ", words.say("planted.alone", "alone"_a = alone));
    return t;
}

}   // namespace

void add_discussion(report::Section& section, const std::vector<Certified>& meshes, const std::vector<FaultTrial>& trials,
                    const Specimen& specimen) {
    add_words(section, words, "discussion");
    add_paragraphs(section, {about_spectra(meshes), about_faults(trials, specimen)});
}

}   // namespace meshfolio::certificates
