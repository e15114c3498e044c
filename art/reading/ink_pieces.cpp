#include "art/reading/ink_pieces.h"

#include <algorithm>
#include <cmath>

namespace sikku {

InkPieces::InkPieces(const GreyPicture& ink, double level, glm::dvec2 low, glm::dvec2 high) {
    const auto limited = [](double value, std::size_t size) {
        return static_cast<std::size_t>(std::clamp(value, 0.0, static_cast<double>(size)));
    };
    left_ = limited(std::floor(low.x), ink.width);
    top_ = limited(std::floor(low.y), ink.height);
    const std::size_t right = std::max(left_, limited(std::ceil(high.x) + 1, ink.width));
    const std::size_t bottom = std::max(top_, limited(std::ceil(high.y) + 1, ink.height));
    width_ = right - left_;
    pieces_.resize(width_ * (bottom - top_));
    const auto least = static_cast<float>(level);
    const auto is_ink = [&](std::size_t at) {
        return ink.values[(top_ + at / width_) * ink.width + left_ + at % width_] >= least;
    };
    std::vector<std::size_t> stack;
    std::uint32_t count = 0;
    for (std::size_t first = 0; first < pieces_.size(); ++first) {
        if (pieces_[first] != 0 || !is_ink(first)) continue;
        pieces_[first] = ++count;
        stack.assign(1, first);
        std::size_t least_x = first % width_;
        std::size_t most_x = least_x;
        std::size_t last = first;
        while (!stack.empty()) {
            const std::size_t at = stack.back();
            stack.pop_back();
            const std::size_t x = at % width_;
            least_x = std::min(least_x, x);
            most_x = std::max(most_x, x);
            last = std::max(last, at);
            const std::size_t before = x > 0 ? 1 : 0;
            const std::size_t after = x + 1 < width_ ? 1 : 0;
            for (std::size_t row = at >= width_ ? at - width_ : at; row <= at + width_ && row < pieces_.size();
                 row += width_) {
                for (std::size_t next = row - before; next <= row + after; ++next) {
                    if (pieces_[next] != 0 || !is_ink(next)) continue;
                    pieces_[next] = count;
                    stack.push_back(next);
                }
            }
        }
        sizes_.push_back(static_cast<double>(std::max(most_x - least_x, last / width_ - first / width_) + 1));
    }
}

std::uint32_t InkPieces::at(glm::dvec2 place) const {
    const double x = std::floor(place.x + 0.5) - static_cast<double>(left_);
    const double y = std::floor(place.y + 0.5) - static_cast<double>(top_);
    if (!(x >= 0 && y >= 0 && x < static_cast<double>(width_) && y * static_cast<double>(width_) < 1e15)) return 0;
    const std::size_t index = static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x);
    return index < pieces_.size() ? pieces_[index] : 0;
}

double InkPieces::size(std::uint32_t piece) const {
    return piece == 0 || piece > sizes_.size() ? 0 : sizes_[piece - 1];
}

}  // namespace sikku
