#include "art/print/screen.h"

#include "engine/base/decimal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace sikku {

Screen parse_screen(std::string_view text) {
    constexpr std::string_view halftone = "halftone";
    if (text == "threshold") return {};
    if (text == "diffusion") return {Screen::Kind::diffusion, 0.0};
    Screen screen{Screen::Kind::halftone, 0.0};
    if (text == halftone) return screen;
    if (text.starts_with(halftone) && text[halftone.size()] == ',') {
        const char* const end = text.data() + text.size();
        const auto [at, error] = parse_number(text.substr(halftone.size() + 1), screen.lines);
        if (error == std::errc() && at == end && screen.lines >= 1 && screen.lines <= 1000) return screen;
    }
    throw std::runtime_error(fmt::format(
        "screen '{}': expected threshold, diffusion, halftone, or halftone,LPI with 1 to 1000 lines per inch", text));
}

Screener::Screener(const Screen& screen, int width, double dpi) : kind_(screen.kind) {
    if (kind_ == Screen::Kind::diffusion) {
        errors_.resize(static_cast<std::size_t>(width) + 2);
        next_errors_.resize(errors_.size());
    }
    if (kind_ != Screen::Kind::halftone) return;
    // Dots in rows at 45 degrees lie at (p, p) and (p, -p): a square of 2p holds two.
    const double lines = screen.lines > 0 ? screen.lines : dpi / 12;
    const double pitch = std::round(dpi / lines / std::numbers::sqrt2);
    if (!(pitch >= 2 && pitch <= 1000)) {
        throw std::runtime_error(fmt::format(
            "a halftone of {:g} lines per inch at {:g} dpi has dots {:.3g} pixels apart; expected 3 to 1400", lines,
            dpi, dpi / lines));
    }
    side_ = 2 * static_cast<std::size_t>(pitch);
    std::vector<double> heights(side_ * side_);
    for (std::size_t y = 0; y < side_; ++y) {
        for (std::size_t x = 0; x < side_; ++x) {
            const double right = (static_cast<double>(x) + 0.5) * std::numbers::pi / pitch;
            const double down = (static_cast<double>(y) + 0.5) * std::numbers::pi / pitch;
            // Rounded, so that pixels at the same distance from their dot are equal on every machine.
            heights[y * side_ + x] = std::round(std::cos(right) * std::cos(down) * -1e9);
        }
    }
    // Each pixel's rank in the tile is its threshold, so that every grey covers its share.
    std::vector<std::uint32_t> order(heights.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return heights[a] != heights[b] ? heights[a] < heights[b] : a < b;
    });
    thresholds_.resize(heights.size());
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
        // From 255 down to 1.
        thresholds_[order[rank]] = static_cast<std::uint8_t>(255 - rank * 255 / order.size());
    }
}

void Screener::row(std::span<const std::uint8_t> greys, std::span<std::uint8_t> result) {
    if (kind_ == Screen::Kind::diffusion) {
        diffuse(greys, result);
    } else if (kind_ == Screen::Kind::halftone) {
        const std::uint8_t* thresholds = thresholds_.data() + next_row_ % side_ * side_;
        for (std::size_t x = 0; x < greys.size(); ++x) result[x] = greys[x] < thresholds[x % side_] ? 0 : 255;
    } else {
        std::transform(greys.begin(), greys.end(), result.begin(),
                       [](std::uint8_t grey) { return static_cast<std::uint8_t>(grey < 128 ? 0 : 255); });
    }
    ++next_row_;
}

void Screener::diffuse(std::span<const std::uint8_t> greys, std::span<std::uint8_t> result) {
    std::swap(errors_, next_errors_);
    std::fill(next_errors_.begin(), next_errors_.end(), 0);
    const bool is_back = next_row_ % 2 == 1;
    for (std::size_t i = 0; i < greys.size(); ++i) {
        const std::size_t x = is_back ? greys.size() - 1 - i : i;
        // errors_ and next_errors_ hold pixel x at x + 1.
        const std::size_t ahead = is_back ? x : x + 2;
        const std::size_t behind = is_back ? x + 2 : x;
        const int wanted = 16 * greys[x] + errors_[x + 1];
        // Pure black and white stay unchanged, so that lines keep their edges.
        const bool is_white = greys[x] == 255 || (greys[x] != 0 && wanted >= 16 * 128);
        result[x] = is_white ? 255 : 0;
        if (greys[x] == 0 || greys[x] == 255) continue;
        const int error = wanted - (is_white ? 16 * 255 : 0);
        const int right = error * 7 / 16;
        const int below_behind = error * 3 / 16;
        const int below = error * 5 / 16;
        errors_[ahead] += right;
        next_errors_[behind] += below_behind;
        next_errors_[x + 1] += below;
        next_errors_[ahead] += error - right - below_behind - below;
    }
}

}  // namespace sikku
