// engine/base/json.h: parses untrusted JSON.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace sikku {

/// An error in a text, at a byte counted from 1.
class JsonError : public std::runtime_error {
public:
    JsonError(const std::string& message, std::size_t at) : std::runtime_error(message), byte(at) {}
    std::size_t byte;
};

/// Objects keep the order of their keys. Time: linear, as objects and the text are limited.
/// @param key_places  receives the offset of each key of each object, in the order of the text
/// @throws JsonError for invalid JSON, more than 50 nested brackets, more than 100,000 values, more than 1,000 keys
/// in an object, a number outside the range of double, or a duplicate key in an object
nlohmann::ordered_json read_json(const std::string& text, std::vector<std::size_t>* key_places = nullptr);

}  // namespace sikku
