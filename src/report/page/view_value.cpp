#include "report/page/view_value.h"

#include <string>

namespace meshfolio::report {

namespace {

thread_local bool meanings_are_kept = false;

}   // namespace

KeptMeanings::KeptMeanings() { meanings_are_kept = true; }
KeptMeanings::~KeptMeanings() { meanings_are_kept = false; }

void enter(nlohmann::json& view, std::initializer_list<ViewValue> values) {
    for (const ViewValue& one : values) {
        view[one.tag] = std::move(one.value);
        if (meanings_are_kept) view[KeptMeanings::key][one.tag] = one.meaning;
    }
}

nlohmann::json view_of(std::initializer_list<ViewValue> values) {
    nlohmann::json view = nlohmann::json::object();
    enter(view, values);
    return view;
}

void enter_list(nlohmann::json& view, const char* tag, const char* meaning, nlohmann::json list) {
    const std::string condition = "has_" + std::string(tag);
    enter(view, {{condition.c_str(), "there are any", !list.empty()}, {tag, meaning, std::move(list)}});
}

}   // namespace meshfolio::report
