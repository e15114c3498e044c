#include "art/reading/picture_region.h"

#include "art/reading/picture_sampler.h"
#include "engine/base/decimal.h"
#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace sikku {
namespace {

constexpr int most_region_side = 8000;

/// Reads numbers that are separated by commas and blanks.
std::vector<double> numbers_of(std::string_view text) {
    std::vector<double> numbers;
    for (const std::string_view word : split_words(text, ", \t")) {
        double number = 0;
        const auto [end, error] = parse_number(word, number);
        if (error != std::errc() || end != word.data() + word.size()) return {};
        numbers.push_back(number);
    }
    const bool are_pixels =
        std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::fabs(number) < 1e6; });
    return are_pixels ? numbers : std::vector<double>{};
}

double cross(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

void check_within(const PictureRegion& region, const DecodedPicture& picture) {
    for (const glm::dvec2 corner : region.corners) {
        const bool is_within = corner.x >= 0 && corner.y >= 0 && corner.x <= picture.file_width + 1 &&
                               corner.y <= picture.file_height + 1;
        if (is_within) continue;
        throw std::runtime_error(fmt::format("the point {:.0f},{:.0f} lies outside of the picture of {} x {} pixels",
                                             corner.x, corner.y, picture.file_width, picture.file_height));
    }
}

}  // namespace

glm::dvec2 PictureRegion::size() const {
    const auto [a, b, c, d] = corners;
    return 0.5 * glm::dvec2(glm::distance(a, b) + glm::distance(d, c), glm::distance(a, d) + glm::distance(b, c));
}

Homography PictureRegion::to_file() const {
    const glm::dvec2 far = size();
    const std::array<glm::dvec2, 4> from = {{{0, 0}, {far.x, 0}, far, {0, far.y}}};
    return Homography::fit(from, corners).value_or(Homography());
}

PictureRegion parse_crop(std::string_view text) {
    const std::vector<double> n = numbers_of(text);
    if (n.size() != 4 || n[0] < 0 || n[1] < 0 || n[2] < 1 || n[3] < 1) {
        throw std::runtime_error(
            fmt::format("'{}': expected X,Y,WIDTH,HEIGHT in pixels, such as 200,100,1200,900", printable(text, 80)));
    }
    const glm::dvec2 low(std::floor(n[0]), std::floor(n[1]));
    const glm::dvec2 far(std::floor(n[2]), std::floor(n[3]));
    return {{low, low + glm::dvec2(far.x, 0), low + far, low + glm::dvec2(0, far.y)}};
}

PictureRegion parse_corners(std::string_view text) {
    const std::vector<double> n = numbers_of(text);
    if (n.size() != 8) {
        throw std::runtime_error(fmt::format(
            "'{}': expected four points 'X,Y X,Y X,Y X,Y' in pixels, around the region from its top left corner",
            printable(text, 80)));
    }
    PictureRegion region;
    for (std::size_t i = 0; i < 4; ++i) region.corners[i] = {n[2 * i] + 0.5, n[2 * i + 1] + 0.5};
    std::array<double, 4> turns{};
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec2 at = region.corners[(i + 1) % 4];
        turns[i] = cross(at - region.corners[i], region.corners[(i + 2) % 4] - at);
    }
    const auto [least, most] = std::minmax_element(turns.begin(), turns.end());
    if (*least < 1 && *most > -1) {
        throw std::runtime_error(
            fmt::format("'{}': these are not the corners of a quadrangle; expected four points around a region, from "
                        "its top left corner",
                        printable(text, 80)));
    }
    if (*most < 0) std::swap(region.corners[1], region.corners[3]);
    return region;
}

DecodedPicture read_region(const PictureDecoder& decode, const PictureRegion& region, int longest_side) {
    const DecodedPicture picture = decode(most_region_side);
    check_within(region, picture);
    const glm::dvec2 size = region.size();
    const int factor = std::max(1, static_cast<int>(std::ceil(std::max(size.x, size.y) / longest_side)));
    DecodedPicture cut;
    cut.file_width = std::max(1, static_cast<int>(std::lround(size.x)));
    cut.file_height = std::max(1, static_cast<int>(std::lround(size.y)));
    cut.width = std::max(1, cut.file_width / factor);
    cut.height = std::max(1, cut.file_height / factor);
    const Homography to_file = region.to_file();
    const double reduced = static_cast<double>(picture.width) / picture.file_width;
    const glm::dvec2 scale = size / glm::dvec2(cut.width, cut.height);
    const PictureSampler sampler(picture);
    // Samples of a square; a few are enough for the finest pictures.
    const int samples = std::min(factor, 4);
    cut.pixels.reserve(3 * static_cast<std::size_t>(cut.width) * static_cast<std::size_t>(cut.height));
    for (int y = 0; y < cut.height; ++y) {
        for (int x = 0; x < cut.width; ++x) {
            std::array<double, 3> sums{};
            for (int k = 0; k < samples * samples; ++k) {
                const glm::dvec2 within = (glm::dvec2(k % samples, k / samples) + 0.5) / static_cast<double>(samples);
                sampler.add(reduced * to_file(scale * (glm::dvec2(x, y) + within)), sums);
            }
            for (const double sum : sums) {
                cut.pixels.push_back(static_cast<std::uint8_t>(std::lround(sum / (samples * samples))));
            }
        }
    }
    return cut;
}

}  // namespace sikku
