// studio/editor/request_members.h: reads the members of untrusted requests in JSON.
#pragma once

#include "studio/editor/text_edit.h"

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sikku {

using Json = nlohmann::ordered_json;

/// Reports a request that does not conform to its protocol.
class BadRequest : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// @throws BadRequest if the member is missing
const Json& member(const Json& request, const std::string& name);
/// @throws BadRequest if the member is not a string, or is missing and there is no `otherwise`
std::string text_of(const Json& request, const std::string& name);
std::string text_of(const Json& request, const std::string& name, const std::string& otherwise);
double number_of(const Json& request, const std::string& name, double otherwise);
/// Parses a whole number in decimal digits.
std::uint64_t whole_of(const Json& value, const std::string& name);
bool flag_of(const Json& request, const std::string& name);
/// A line or column from 0. @throws BadRequest
std::size_t position_of(const Json& request, const std::string& name);
/// `{"line": 2, "character": 7}`. @throws BadRequest
EditorPosition place_of(const Json& position);

/// Reads pairs of strings: `[["size", "A3"], …]`; empty if the member is missing.
std::vector<std::pair<std::string, std::string>> pairs_of(const Json& request, const std::string& name);

}  // namespace sikku
