#include <algorithm>
#include <array>

#include "questions/question.h"

namespace meshfolio {

std::span<const Question> question_list() {
    static constexpr std::array<Question, 7> questions{{
        {"q1", "Uniform Laplace curvature",
         "Mean curvature from the uniform Laplacian and Gaussian curvature from the angle deficit: are they good approximations?",
         answer_q1},
        {"q2", "Fundamental forms of the ellipsoid",
         "First and second fundamental form in closed form, and the normal curvature at (a, 0, 0).", answer_q2},
        {"q3", "Cotangent Laplace–Beltrami curvature", "Does the cotangent discretisation improve the estimated mean curvature?",
         answer_q3},
        {"q4", "Spectral reconstruction", "Reconstructions from the k smoothest eigenvectors: does a larger k give better ones?",
         answer_q4},
        {"q5", "Explicit Laplacian smoothing", "What is a good step size λ, and what happens when it is too large?", answer_q5},
        {"q6", "Implicit Laplacian smoothing",
         "Backward Euler smoothing compared with the explicit method for several step sizes and iterations.", answer_q6},
        {"q7", "Denoising", "When does Laplacian denoising work, and when does it fail?", answer_q7},
    }};
    return questions;
}

std::span<const Question> supporting_list() {
    static constexpr std::array sections{
        Question{"truth", "Ground truth",
                 "How far are estimates of curvature from the truth, on surfaces where it is known, and does refinement help?",
                 answer_truth},
        Question{"stability", "Certified stability",
                 "How large a step does explicit smoothing bear, which vertex sets the limit, and is that proved?", answer_stability},
        Question{"maps", "Smoothing maps",
                 "What does each step size do after each number of iterations, explicit and implicit, and where does it go wrong?",
                 answer_maps},
        Question{"modes", "Mode by mode",
                 "Does each eigenmode fade as the laws say, how far are the two schemes apart, and when is implicit cheaper?",
                 answer_modes},
        Question{"operators", "Operator laboratory",
                 "What does each way of building the discrete Laplacian keep, what does it give up, and what does that change?",
                 answer_operators},
        Question{"certificates", "Certificates",
                 "Are the spectra right and complete, do the operators obey their laws, and would the checks see a fault?",
                 answer_certificates},
        Question{"preflight", "Preflight", "What is each mesh, what is wrong with it, what does that affect, and what was done?",
                 answer_preflight},
    };
    return sections;
}

const Question* question_of_id(std::string_view id) {
    for (const auto& list : {question_list(), supporting_list()}) {
        const auto it = std::find_if(list.begin(), list.end(), [&](const Question& q) { return q.id == id; });
        if (it != list.end()) return &*it;
    }
    return nullptr;
}

std::vector<std::string> section_ids() {
    std::vector<std::string> ids;
    for (const auto& list : {question_list(), supporting_list()}) {
        for (const Question& question : list) ids.emplace_back(question.id);
    }
    return ids;
}

}   // namespace meshfolio
