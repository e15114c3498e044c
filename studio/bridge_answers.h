// studio/bridge_answers.h: reads requests, and answers those that need more than a few lines.
#pragma once

#include "engine/base/monitor.h"
#include "engine/interpreter.h"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sikku {

using Json = nlohmann::ordered_json;

/// Reports a request that does not conform to studio/page/protocol.ts.
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

/// Reads pairs of strings: `[["size", "A3"], …]`; empty if the member is missing.
std::vector<std::pair<std::string, std::string>> pairs_of(const Json& request, const std::string& name);

/// The interpreter that a request names: `draw` or `play`. @throws BadRequest
const Interpreter& interpreter_of(const Json& request);
/// The member `options` of a request.
OptionValues options_of(const Json& request);
/// The compiled pattern of a request, which is cached. @throws PatternError
Document document_of(const Json& request);
/// Names an output: `curve.svg` for curve.lsys.
std::string output_name(const Document& document, const std::string& format);

Json json_of(const std::vector<Remark>& remarks);
Json json_of(const std::vector<Diagnostic>& diagnostics);

// One function for each kind of request.
Json answer_open(const Json& request, const Monitor& monitor);
Json answer_pixels(const Json& request, const Monitor& monitor, std::string& bytes);
Json answer_affordable(const Json& request, const Monitor& monitor);
Json answer_origins(const Json& request, const Monitor& monitor);
Json answer_import(const Json& request, const std::string& file);
Json answer_scale(const Json& request, const std::string& file);
Json answer_show(const Json& request, const std::string& file);
Json answer_dots(const Json& request);
Json answer_grid(const Json& request, const Monitor& monitor);
Json answer_read(const Json& request, const std::string& file, const Monitor& monitor, std::string& bytes);
Json answer_command(const Json& request);
Json answer_link(const Json& request);
Json answer_read_link(const Json& request);

}  // namespace sikku
