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

}   // namespace meshfolio
