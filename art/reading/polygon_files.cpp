#include "art/reading/polygon_files.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace sikku {

std::string line_and_column(std::string_view text, std::size_t at) {
    const std::string_view before = text.substr(0, std::min(at, text.size()));
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const std::size_t start = before.rfind('\n');
    return fmt::format("line {}, column {}", line,
                       before.size() - (start == std::string_view::npos ? 0 : start + 1) + 1);
}

namespace {

constexpr std::size_t most_nested = 50;

/// Collects polygons from the events of a parser.
class JsonPolygons : public nlohmann::json_sax<nlohmann::json> {
public:
    JsonPolygons(std::string_view text, const Monitor& monitor) : text_(text), pulse_(monitor) {}

    bool null() override { return value("null"); }
    bool boolean(bool) override { return value("a truth value"); }
    bool number_integer(number_integer_t number) override { return take(static_cast<double>(number)); }
    bool number_unsigned(number_unsigned_t number) override { return take(static_cast<double>(number)); }
    bool number_float(number_float_t number, const string_t&) override { return take(number); }
    bool string(string_t& text) override {
        if (in() == In::top && key_ == "title") polygons_.title = printable(text, 200);
        return value("a text");
    }
    bool binary(binary_t&) override { return value("bytes"); }
    bool key(string_t& name) override {
        key_ = name;
        if (in() == In::top) has_list_ = has_list_ || name == "list";
        return true;
    }
    bool start_object(std::size_t) override {
        if (in() == In::list) {
            corners_seen_ = false;
            colour_ = 0;
            return push(In::tile);
        }
        return push(open("an object", nested_.empty() ? In::top : In::skipped));
    }
    bool start_array(std::size_t) override {
        switch (in()) {
            case In::nothing:
                has_list_ = true;
                return push(In::list);
            case In::top:
                return push(key_ == "list" ? In::list : In::skipped);
            case In::list:
                colour_ = 0;
                return push(In::polygon);
            case In::tile:
                if (key_ != "corners") return push(In::skipped);
                if (std::exchange(corners_seen_, true)) refuse("'corners' occurs twice");
                return push(In::polygon);
            case In::polygon:
                numbers_ = 0;
                return push(In::corner);
            case In::corner:
                refuse_corner("a list");
            default:
                return push(In::skipped);
        }
    }
    bool end_object() override {
        if (in() == In::tile) {
            if (!corners_seen_) refuse("'corners' is missing");
            polygons_.end_polygon(colour_);
        }
        nested_.pop_back();
        return true;
    }
    bool end_array() override {
        pulse_();
        const In ended = in();
        nested_.pop_back();
        if (ended == In::corner) {
            if (numbers_ != 2) refuse_corner(counted(numbers_, "number"));
            if (polygons_.corners.size() >= most_polygon_corners) {
                throw std::runtime_error(fmt::format("the polygons have more than {} corners", most_polygon_corners));
            }
            polygons_.corners.emplace_back(at_[0], at_[1]);
        } else if (ended == In::polygon) {
            if (polygons_.corners.size() - polygons_.begin.back() < 3) refuse("a polygon has three corners or more");
            if (in() == In::list) polygons_.end_polygon(0);
        }
        return true;
    }
    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception&) override {
        // The parser counts the bytes that it read.
        throw std::runtime_error(
            fmt::format("{}: this is not valid JSON", line_and_column(text_, position > 0 ? position - 1 : 0)));
    }

    PolygonList finish() {
        if (!has_list_)
            throw std::runtime_error("expected a list of polygons, or an object with such a list as 'list'");
        return std::move(polygons_);
    }

private:
    /// The contents of the innermost bracket.
    enum class In : std::uint8_t { nothing, top, list, tile, polygon, corner, skipped };

    In in() const { return nested_.empty() ? In::nothing : nested_.back(); }
    bool push(In inside) {
        if (nested_.size() >= most_nested)
            throw std::runtime_error(fmt::format("more than {} nested brackets", most_nested));
        nested_.push_back(inside);
        return true;
    }
    [[noreturn]] void refuse(const std::string& what) const {
        throw std::runtime_error(fmt::format("polygon {}: {}", polygons_.size() + 1, what));
    }
    [[noreturn]] void refuse_corner(const std::string& what) const {
        refuse(fmt::format("corner {}: expected [x, y], not {}",
                           polygons_.corners.size() - polygons_.begin.back() + 1, what));
    }
    /// Handles anything except a number or a bracket.
    bool value(const char* what) {
        open(what, In::skipped);
        return true;
    }
    /// Refuses `what` where only something else may stand; else returns `inside`.
    In open(const char* what, In inside) const {
        if (in() == In::nothing && inside == In::skipped) {
            throw std::runtime_error(fmt::format("expected a list of polygons, not {}", what));
        }
        if (in() == In::list) refuse(fmt::format("expected a list of corners, not {}", what));
        if (in() == In::polygon || in() == In::corner) refuse_corner(what);
        if (in() == In::tile && key_ == "corners")
            refuse(fmt::format("'corners' is {}, not a list of corners", what));
        if (in() == In::top && key_ == "list") {
            throw std::runtime_error(fmt::format("'list' is {}, not a list of polygons", what));
        }
        return inside;
    }
    bool take(double number) {
        if (in() == In::corner) {
            if (!(std::fabs(number) <= most_polygon_coordinate)) {
                refuse_corner(fmt::format("{:g}, which is larger than {:g}", number, most_polygon_coordinate));
            }
            if (numbers_ < 2) at_[numbers_] = number;
            ++numbers_;
            return true;
        }
        if (in() == In::tile && key_ == "colour") {
            if (!(std::fabs(number) <= 1e6) || number != std::floor(number)) {
                refuse("'colour' is not a whole number of up to a million");
            }
            colour_ = static_cast<std::int32_t>(number);
            return true;
        }
        if (in() == In::top && key_ == "violations" && number > 0) {
            polygons_.notes.push_back(
                fmt::format("an earlier examination of its list found {:.0f} violations; polygons that are not tiles "
                            "may be missing from it",
                            number));
        }
        return value("a number");
    }

    std::string_view text_;
    Pulse pulse_;
    PolygonList polygons_;
    std::vector<In> nested_;
    std::string key_;
    bool has_list_ = false;
    bool corners_seen_ = false;
    std::int32_t colour_ = 0;
    std::size_t numbers_ = 0;
    std::array<double, 2> at_{};
};

}  // namespace

PolygonList read_polygons_json(std::string_view text, const Monitor& monitor) {
    JsonPolygons polygons(text, monitor);
    nlohmann::json::sax_parse(text.begin(), text.end(), &polygons);
    return polygons.finish();
}

}  // namespace sikku
