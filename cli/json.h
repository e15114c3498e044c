// cli/json.h: JSON that others may have written.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace sikku {

/// What is wrong with a text, and at which of its bytes, from 1.
class JsonError : public std::runtime_error {
public:
    JsonError(const std::string& message, std::size_t at) : std::runtime_error(message), byte(at) {}
    std::size_t byte;
};

/// Objects keep the order of their keys. @throws JsonError for what is no JSON, more than 50 brackets deep, a number
/// that doubles do not hold, or a key that stands twice in an object
nlohmann::ordered_json read_json(const std::string& text);

}  // namespace sikku
