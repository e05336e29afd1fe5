/// @file
/// The picture on the first page: of the figures of one mesh with values, one that readers can turn if there is one, the mesh that is bent
/// most, seen from the right front and above.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "run/run_questions.h"

namespace meshfolio::run {

/// The cover that an answer of this run offers.
CoverOffer offer_of(const Answer& answer);

struct Cover {
    std::size_t result = 0;   // whose figure it is
    CoverOffer offer;
    std::optional<output::FigureRequest> request;   // to be drawn; none: it is stored
    std::optional<StoredAnswer> stored;

    report::Cover figure(const std::vector<QuestionResult>& results) const;
};

/// @param answer_again  answers a question that is stored without its picture for the cover, in place of the stored answer
/// @return nothing where no answer has a figure that will do
std::optional<Cover> chosen_cover(std::vector<QuestionResult>& results,
                                  const std::function<QuestionResult(const std::string& id)>& answer_again);

}   // namespace meshfolio::run
