// engine/base/json_text.h: formats values as JSON on one line, as `{"a": 1, "b": [2, 3]}`.
#pragma once

#include "engine/base/text.h"

#include <fmt/format.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <ranges>
#include <string>
#include <string_view>
#include <utility>

namespace sikku {

/// A value as JSON.
class JsonText {
public:
    JsonText(std::nullptr_t) : text("null") {}
    JsonText(bool value) : text(value ? "true" : "false") {}
    template <class Number>
    requires std::integral<Number> || std::floating_point<Number> JsonText(Number value)
        : text(fmt::format("{}", value)) {}
    JsonText(std::string_view value) : text(json_string(value)) {}
    JsonText(const std::string& value) : text(json_string(value)) {}
    JsonText(const char* value) : text(json_string(value)) {}
    template <class Value>
    JsonText(const std::optional<Value>& value) : JsonText(value ? JsonText(*value) : JsonText(nullptr)) {}
    template <class First, class Second>
    JsonText(const std::pair<First, Second>& two) : JsonText(std::array{JsonText(two.first), JsonText(two.second)}) {}
    template <std::ranges::range List>
    JsonText(const List& values) : JsonText(list(values, [](const auto& each) { return JsonText(each); })) {}

    /// Takes text that is JSON.
    static JsonText raw(std::string json) {
        JsonText result(nullptr);
        result.text = std::move(json);
        return result;
    }
    /// A list of the values that `of` returns for the elements of a range.
    template <class List, class Of>
    static JsonText list(const List& values, Of&& of) {
        std::string text = "[";
        for (const auto& each : values) text += (text.size() > 1 ? ", " : "") + JsonText(of(each)).text;
        return raw(text + "]");
    }
    /// An object with a member for each pair of a range.
    template <class Pairs>
    static JsonText object_of(const Pairs& pairs) {
        std::string text = "{";
        for (const auto& [key, value] : pairs) add_members(text, fmt::format("{}", key), value);
        return raw(text + "}");
    }
    /// An object: keys and their values in turn.
    template <class... Members>
    static JsonText object(const Members&... members) {
        std::string text = "{";
        add_members(text, members...);
        return raw(text + "}");
    }
    /// A string, or null if it is empty.
    static JsonText unless_empty(const std::string& value) {
        return value.empty() ? JsonText(nullptr) : JsonText(value);
    }
    /// A number, as a string of digits from 2^53 on, where doubles do not hold it.
    static JsonText whole(std::int64_t value) {
        return value < (std::int64_t{1} << 53) ? JsonText(value) : JsonText(std::to_string(value));
    }

    /// The members of this object, then those of another one.
    JsonText and_members_of(const JsonText& other) const {
        return raw(text.substr(0, text.size() - 1) + ", " + other.text.substr(1));
    }
    std::string line() const { return text + "\n"; }

    std::string text;

private:
    template <class Value, class... Rest>
    static void add_members(std::string& text, std::string_view key, const Value& value, const Rest&... rest) {
        text += (text.size() > 1 ? ", " : "") + json_string(key) + ": " + JsonText(value).text;
        if constexpr (sizeof...(rest) > 0) add_members(text, rest...);
    }
};

}  // namespace sikku
