#include "art/gallery/values.h"

#include "engine/base/json.h"

#include <fmt/format.h>

namespace sikku {
namespace {

/// Converts the JSON of a line into values; keys keep the order of the line.
class JsonLine {
public:
    JsonLine(const std::string& place, const std::string& line) : place_(place), line_(line) {
        json_ = read_json(line, &keys_);
    }

    bool is_object() const { return json_.is_object(); }
    GalleryValue value() { return value_of(json_, place_ + ":1"); }

private:
    GalleryValue value_of(const nlohmann::ordered_json& json, const std::string& place) {
        GalleryValue value;
        value.place = place;
        if (json.is_string()) {
            value.text = json.get<std::string>();
        } else if (json.is_number_float()) {
            value.text = fmt::format("{}", json.get<double>());
            if (value.text.ends_with(".0")) value.text.resize(value.text.size() - 2);
        } else if (json.is_number() || json.is_boolean()) {
            value.text = json.dump();
        } else if (json.is_array()) {
            value.type = GalleryValue::Type::list;
            value.list.reserve(json.size());
            for (const auto& element : json) value.list.push_back(value_of(element, place));
        } else if (json.is_object()) {
            value.type = GalleryValue::Type::table;
            value.table.reserve(json.size());
            for (const auto& [key, element] : json.items()) {
                const std::string key_place = next_key();
                value.table.push_back({key, value_of(element, key_place)});
            }
        } else {
            value.type = GalleryValue::Type::other;
        }
        return value;
    }

    /// The place of the next key, in columns as editors count.
    std::string next_key() {
        const std::size_t end = met_ < keys_.size() ? keys_[met_++] : at_;
        for (; at_ < end; ++at_) column_ += (static_cast<unsigned char>(line_[at_]) & 0xC0) != 0x80 ? 1 : 0;
        return fmt::format("{}:{}", place_, column_);
    }

    const std::string& place_;
    const std::string& line_;
    std::vector<std::size_t> keys_;
    nlohmann::ordered_json json_;
    std::size_t met_ = 0;     // keys reported so far
    std::size_t at_ = 0;      // in the line
    std::size_t column_ = 1;  // column of at_
};

}  // namespace

GalleryValue read_manifest_line(const std::string& place, const std::string& line) {
    try {
        JsonLine read(place, line);
        if (!read.is_object()) fail(place + ":1", "expected a job: { \"pattern\": … }");
        return read.value();
    } catch (const JsonError& error) {
        fail(fmt::format("{}:{}", place, error.byte), error.what());
    }
}

}  // namespace sikku
