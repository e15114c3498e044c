#include "art/reading/svg_path.h"

#include "engine/base/diagnostic.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>

namespace sikku {
namespace {

constexpr int chords = 12;

class PathReader {
public:
    PathReader(std::string_view data, std::size_t most) : data_(data), most_(most) {}

    std::vector<FlatPath> read() {
        skip();
        while (at_ < data_.size()) {
            char command = data_[at_];
            if (std::string_view("MmLlHhVvCcSsQqTtAaZz").find(command) == std::string_view::npos) fail();
            ++at_;
            if (paths_.empty() && command != 'M' && command != 'm') fail();
            if (command == 'Z' || command == 'z') {
                paths_.back().is_closed = true;
                here_ = start_;
                last_ = 'z';
                skip();
                continue;
            }
            do {
                step(command);
                skip();
                if (command == 'M') command = 'L';
                if (command == 'm') command = 'l';
            } while (at_ < data_.size() && is_number());
        }
        for (FlatPath& path : paths_) {
            if (path.points.size() > 1 && glm::distance(path.points.front(), path.points.back()) < 1e-9) {
                path.points.pop_back();
                path.is_closed = true;
            }
        }
        return std::move(paths_);
    }

private:
    [[noreturn]] void fail() const {
        throw std::runtime_error(fmt::format("damaged path data at byte {}: '{}'", at_ + 1,
                                             printable(data_.substr(std::min(at_, data_.size()), 20))));
    }
    void skip() {
        while (at_ < data_.size() && std::string_view(" \t\r\n,").find(data_[at_]) != std::string_view::npos) ++at_;
    }
    bool is_number() const { return std::string_view("0123456789.+-").find(data_[at_]) != std::string_view::npos; }
    double number() {
        skip();
        std::size_t end = at_;
        const auto is = [&](std::string_view set) { return end < data_.size() && set.find(data_[end]) != set.npos; };
        if (is("+-")) ++end;
        while (is("0123456789")) ++end;
        if (is(".")) ++end;
        while (is("0123456789")) ++end;
        if (is("eE")) {
            ++end;
            if (is("+-")) ++end;
            while (is("0123456789")) ++end;
        }
        std::string_view word = data_.substr(at_, end - at_);
        if (word.starts_with('+')) word.remove_prefix(1);
        std::string padded(word);
        if (padded.ends_with('.')) padded += '0';
        double value = 0;
        if (!read_number(padded, value) || !(std::fabs(value) < 1e12)) fail();
        at_ = end;
        return value;
    }
    bool flag() {
        skip();
        if (at_ >= data_.size() || (data_[at_] != '0' && data_[at_] != '1')) fail();
        return data_[at_++] == '1';
    }
    glm::dvec2 point(bool relative) {
        const double x = number();
        const double y = number();
        return relative ? here_ + glm::dvec2(x, y) : glm::dvec2(x, y);
    }
    void add(glm::dvec2 to) {
        if (++count_ > most_) throw std::runtime_error(fmt::format("the paths have more than {} points", most_));
        if (last_ == 'z') begin(here_);
        if (paths_.back().points.empty() || paths_.back().points.back() != to) paths_.back().points.push_back(to);
        here_ = to;
    }
    void begin(glm::dvec2 at) {
        paths_.emplace_back();
        paths_.back().points.push_back(at);
        start_ = here_ = at;
        last_ = 'm';
    }
    void step(char command) {
        const bool relative = command >= 'a';
        const char kind = relative ? command : static_cast<char>(command - 'A' + 'a');
        switch (kind) {
            case 'm':
                begin(point(relative && !paths_.empty()));
                break;
            case 'l':
                add(point(relative));
                break;
            case 'h': {
                const double x = number();
                add({relative ? here_.x + x : x, here_.y});
                break;
            }
            case 'v': {
                const double y = number();
                add({here_.x, relative ? here_.y + y : y});
                break;
            }
            case 'c':
            case 's': {
                const glm::dvec2 first = kind == 'c'    ? point(relative)
                                         : last_ == 'c' ? 2.0 * here_ - control_
                                                        : here_;
                const glm::dvec2 second = point(relative);
                cubic(first, second, point(relative));
                return;
            }
            case 'q':
            case 't': {
                const glm::dvec2 middle = kind == 'q'    ? point(relative)
                                          : last_ == 'q' ? 2.0 * here_ - control_
                                                         : here_;
                return quadratic(middle, point(relative));
            }
            default:
                arc(relative);
        }
        last_ = kind;
    }
    void cubic(glm::dvec2 first, glm::dvec2 second, glm::dvec2 to) {
        const glm::dvec2 from = here_;
        for (int i = 1; i <= chords; ++i) {
            const double t = static_cast<double>(i) / chords;
            const double s = 1 - t;
            add(i == chords ? to
                            : s * s * s * from + 3 * s * s * t * first + 3 * s * t * t * second + t * t * t * to);
        }
        control_ = second;
        last_ = 'c';
    }
    void quadratic(glm::dvec2 middle, glm::dvec2 to) {
        cubic(here_ + 2.0 / 3 * (middle - here_), to + 2.0 / 3 * (middle - to), to);
        control_ = middle;
        last_ = 'q';
    }
    void arc(bool relative) {
        double rx = std::fabs(number());
        double ry = std::fabs(number());
        const double tilt = number() * std::numbers::pi / 180;
        const bool is_large = flag();
        const bool is_positive = flag();
        const glm::dvec2 to = point(relative);
        const glm::dvec2 from = here_;
        if (rx == 0 || ry == 0 || from == to) return add(to);
        const glm::dvec2 half = 0.5 * (from - to);
        const double c = std::cos(tilt);
        const double s = std::sin(tilt);
        const glm::dvec2 p(c * half.x + s * half.y, -s * half.x + c * half.y);
        const double size = p.x * p.x / (rx * rx) + p.y * p.y / (ry * ry);
        if (size > 1) {
            rx *= std::sqrt(size);
            ry *= std::sqrt(size);
        }
        const double below = rx * rx * p.y * p.y + ry * ry * p.x * p.x;
        double factor = below > 0 ? std::sqrt(std::max(0.0, rx * rx * ry * ry / below - 1)) : 0;
        if (is_large == is_positive) factor = -factor;
        const glm::dvec2 middle(factor * rx * p.y / ry, -factor * ry * p.x / rx);
        const glm::dvec2 centre =
            glm::dvec2(c * middle.x - s * middle.y, s * middle.x + c * middle.y) + 0.5 * (from + to);
        const double begin = std::atan2((p.y - middle.y) / ry, (p.x - middle.x) / rx);
        double sweep = std::atan2((-p.y - middle.y) / ry, (-p.x - middle.x) / rx) - begin;
        if (is_positive && sweep < 0) sweep += 2 * std::numbers::pi;
        if (!is_positive && sweep > 0) sweep -= 2 * std::numbers::pi;
        const int pieces = std::max(1, static_cast<int>(std::ceil(std::fabs(sweep) / (std::numbers::pi / 6))));
        for (int i = 1; i <= pieces; ++i) {
            const double angle = begin + sweep * i / pieces;
            const glm::dvec2 on(rx * std::cos(angle), ry * std::sin(angle));
            add(i == pieces ? to : centre + glm::dvec2(c * on.x - s * on.y, s * on.x + c * on.y));
        }
    }

    std::string_view data_;
    std::size_t most_;
    std::size_t at_ = 0;
    std::size_t count_ = 0;
    std::vector<FlatPath> paths_;
    glm::dvec2 here_{0.0};
    glm::dvec2 start_{0.0};
    glm::dvec2 control_{0.0};
    char last_ = 0;
};

}  // namespace

FlatPath path_of_points(const std::vector<double>& coordinates, bool is_polygon) {
    FlatPath path;
    for (std::size_t i = 1; i < coordinates.size(); i += 2) {
        path.points.emplace_back(coordinates[i - 1], coordinates[i]);
    }
    const bool returns = path.points.size() > 2 && path.points.front() == path.points.back();
    path.is_closed = is_polygon || returns;
    if (returns) path.points.pop_back();
    return path;
}

std::size_t first_curve(std::string_view data) {
    return data.find_first_of("CcSsQqTtAa");
}

std::vector<FlatPath> flatten_path(std::string_view data, std::size_t most_points) {
    return PathReader(data, most_points).read();
}

}  // namespace sikku
