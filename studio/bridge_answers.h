// studio/bridge_answers.h: reads requests, and answers those that take more than a few lines.
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

/// A request that does not follow studio/page/protocol.ts.
class BadRequest : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// @throws BadRequest if there is no such member
const Json& member(const Json& request, const std::string& name);
/// @throws BadRequest if the member is not a text; without `otherwise`, if there is none
std::string text_of(const Json& request, const std::string& name);
std::string text_of(const Json& request, const std::string& name, const std::string& otherwise);
double number_of(const Json& request, const std::string& name, double otherwise);
bool flag_of(const Json& request, const std::string& name);

/// Pairs of texts: `[["size", "A3"], …]`; none if there is no such member.
std::vector<std::pair<std::string, std::string>> pairs_of(const Json& request, const std::string& name);

/// The options of a request: `options`.
OptionValues options_of(const Json& request);
/// The compiled pattern of a request, which is kept for the next ones. @throws PatternError
Document document_of(const Json& request);
/// `curve.svg` for curve.lsys.
std::string output_name(const Document& document, const std::string& format);

Json json_of(const std::vector<Remark>& remarks);
Json json_of(const std::vector<Diagnostic>& diagnostics);

// Answers by the name of the request.
Json answer_open(const Json& request, const Monitor& monitor);
Json answer_pixels(const Json& request, const Monitor& monitor, std::string& bytes);
Json answer_origins(const Json& request);
Json answer_import(const Json& request, const std::string& file);
Json answer_scale(const Json& request, const std::string& file);
Json answer_show(const Json& request, const std::string& file);
Json answer_grid(const Json& request, const Monitor& monitor);
Json answer_command(const Json& request);
Json answer_link(const Json& request);
Json answer_read_link(const Json& request);

}  // namespace sikku
