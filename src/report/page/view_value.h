/// @file
/// Objects of the view model, each value with its meaning, which `meshfolio templates --tags` prints.
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>

namespace meshfolio::report {

struct ViewValue {
    const char* tag;
    const char* meaning;
    mutable nlohmann::json value;   // moved into the object it is entered into
};

void enter(nlohmann::json& view, std::initializer_list<ViewValue> values);
nlohmann::json view_of(std::initializer_list<ViewValue> values);

/// A list, and the condition has_… that it holds anything.
void enter_list(nlohmann::json& view, const char* tag, const char* meaning, nlohmann::json list);

template <class Items, class View>
nlohmann::json list_of(const Items& items, View view) {
    nlohmann::json list = nlohmann::json::array();
    for (const auto& item : items) list.push_back(view(item));
    return list;
}

/// While an object lives, views of this thread also store the meaning of each tag under `key`.
struct KeptMeanings {
    static constexpr const char* key = "#meanings";
    KeptMeanings();
    ~KeptMeanings();
    KeptMeanings(const KeptMeanings&) = delete;
    KeptMeanings& operator=(const KeptMeanings&) = delete;
};

}   // namespace meshfolio::report
