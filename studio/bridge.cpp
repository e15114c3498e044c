#include "studio/bridge.h"

#include "art/analysis.h"
#include "art/kolam/kolam_text.h"
#include "art/print/paper.h"
#include "art/prints.h"
#include "engine/base/json.h"
#include "engine/base/keys.h"
#include "engine/base/memory.h"
#include "engine/check.h"
#include "engine/derivation/forecast.h"
#include "engine/derivation/word_printer.h"
#include "engine/map/map_step.h"
#include "engine/measurement.h"
#include "music/scores.h"
#include "studio/bridge_answers.h"
#include "studio/editor/help.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace sikku {
namespace {

using Clock = std::chrono::steady_clock;

/// The deadline of a request.
struct Deadline {
    Clock::time_point end;
};

Monitor monitor_of(Deadline& deadline) {
    return Monitor([](void* context) { return Clock::now() >= static_cast<Deadline*>(context)->end; }, nullptr,
                   &deadline);
}

Json answer_patterns() {
    Json list = Json::array();
    for (const LibraryPattern& known : PatternLibrary::bundled().patterns()) {
        Diagnostics diagnostics;
        const std::string file = known.name + ".lsys";
        const Document document =
            Document::compile(file, read_pattern(PatternFile{file, known.file}), {}, diagnostics);
        diagnostics.throw_if_errors();
        list.push_back({{"name", known.name},
                        {"kind", known.kind},
                        {"title", document.text("title")},
                        {"source", document.text("source")},
                        {"text", document.source().text()},
                        {"is_melody", sets_keys_of(scores(), document)},
                        {"is_spatial", document.grammar().is_spatial()}});
    }
    return {{"patterns", std::move(list)}};
}

/// The texts of the bundled patterns, in the order of `patterns`, separated by NUL. Does not compile them.
Json answer_texts(std::string& bytes) {
    for (const LibraryPattern& known : PatternLibrary::bundled().patterns()) {
        if (!bytes.empty()) bytes += '\0';
        bytes += read_pattern(PatternFile{known.name + ".lsys", known.file});
    }
    return Json::object();
}

Json help_of(const Interpreter& interpreter) {
    static constexpr std::array kinds = {"text", "number", "whole", "flag"};
    Json options = Json::array();
    for (const OptionInfo* option : interpreter.options()) {
        options.push_back({{"name", option->name},
                           {"help", option->help},
                           {"value", option->value},
                           {"group", option->group},
                           {"unit", option->unit},
                           {"kind", kinds[static_cast<std::size_t>(option->kind)]},
                           {"least", option->least},
                           {"most", option->most},
                           {"is_list", option->is_list},
                           {"is_on", option->is_on},
                           {"is_key", option->is_key},
                           {"is_alone", option->is_alone},
                           {"scope", scope_name(option->scope)},
                           {"sets_scale", option->sets_scale},
                           {"names_file", option->names_file != nullptr},
                           {"letter", option->letter ? std::string(1, option->letter) : std::string()}});
    }
    Json formats = Json::array();
    for (const FormatName& format : interpreter.formats()) {
        formats.push_back({{"extension", format.extension},
                           {"label", format.label},
                           {"alias", format.alias},
                           {"is_several", format.is_several},
                           {"is_text", format.is_text}});
    }
    return {{"options", std::move(options)}, {"formats", std::move(formats)}};
}

Json answer_help() {
    static constexpr std::array owners = {"engine", "art", "music"};
    static constexpr std::array scopes = {"words", "maps", "all"};
    Json keys = Json::array();
    for (const KeyInfo& key : language_keys()) {
        keys.push_back({{"name", key.name},
                        {"owner", owners[static_cast<std::size_t>(key.owner)]},
                        {"values", key.values},
                        {"if_absent", key.if_absent},
                        {"scope", scopes[static_cast<std::size_t>(key.scope)]},
                        {"names_file", key.names_file != nullptr},
                        {"help", key.help}});
    }
    Json symbols = Json::array();
    for (const SymbolHelp& row : single_turtle_symbols())
        symbols.push_back({{"symbol", row.symbols}, {"help", row.help}});
    Json sizes = Json::object();
    for (const PaperSize& paper : paper_sizes()) sizes[std::string(paper.name)] = {paper.size.x, paper.size.y};
    return {{"version", SIKKU_VERSION},      {"sizes", std::move(sizes)}, {"keys", std::move(keys)},
            {"symbols", std::move(symbols)}, {"draw", help_of(prints())}, {"play", help_of(scores())}};
}

Json answer_make(const Json& request, const Monitor& monitor, std::string& bytes) {
    if (request.contains("arrangement")) return answer_make_arrangement(request, monitor, bytes);
    const Interpreter& interpreter = interpreter_of(request);
    const std::string format = text_of(request, "format");
    const Assignment assigned = assign(interpreter, document_of(request), options_of(request));
    const std::unique_ptr<Work> work = interpreter.plan(assigned.document, format, assigned.options);
    return made_by(*work, output_name(assigned.document, format), monitor, bytes);
}

/// The text of the word or the map, cut off at the limit of a link.
Json answer_derive(const Json& request, const Monitor& monitor, std::string& bytes) {
    constexpr std::size_t most_bytes = std::size_t{64} << 20U;
    struct Cut {};
    const auto append = [&](std::string_view text) {
        bytes += text;
        if (bytes.size() > most_bytes) throw Cut();
    };
    const Document document = document_of(request);
    try {
        if (document.map()) {
            const double half = static_cast<double>(available_memory()) / 2;
            print_map(derive_map(document.grammar(), {std::numeric_limits<double>::infinity(), half}, monitor),
                      *document.map(), append);
        } else {
            const Grammar grammar = shorten(document.grammar());
            WordPrinter sink(grammar, append);
            DerivationOptions options = DerivationOptions::within(200e6, [&](std::uint64_t) { monitor.check(); });
            options.interpreted = flag_of(request, "interpreted");
            derive(grammar, sink, options);
        }
    } catch (const Cut&) {
        bytes.resize(most_bytes);
        return {{"is_whole", false}};
    }
    return {{"is_whole", true}};
}

Json answer_measure(const Json& request, const Monitor& monitor, std::string& bytes) {
    constexpr double budget = 200e6;
    const Document document = document_of(request);
    bytes = measure_as_json(document, budget, monitor);
    return Json::parse(bytes);
}

Json answer_kolam(const Json& request, const Monitor& monitor, std::string& bytes) {
    constexpr double budget = 200e6;
    const Document document = document_of(request);
    bytes = kolam_json(document.text("title"), document.grammar().steps(), examine_kolam(document, budget, monitor));
    return Json::parse(bytes);
}

Json answer_check(const Json& request, const Monitor& monitor) {
    const Json& pattern = member(request, "pattern");
    const std::array<const Interpreter*, 2> interpreters = {&prints(), &scores()};
    return {{"diagnostics",
             json_of(check_pattern(text_of(pattern, "name"), text_of(pattern, "text"), interpreters, monitor))}};
}

Json answer(const Json& request, const std::string& file, const Monitor& monitor, std::string& bytes) {
    const std::string what = text_of(request, "do");
    if (what == "patterns") return answer_patterns();
    if (what == "texts") return answer_texts(bytes);
    if (what == "arrangements") return answer_arrangements();
    if (what == "help") return answer_help();
    if (what == "open") return answer_open(request, monitor);
    if (what == "make") return answer_make(request, monitor, bytes);
    if (what == "pixels") return answer_pixels(request, monitor, bytes);
    if (what == "derive") return answer_derive(request, monitor, bytes);
    if (what == "measure") return answer_measure(request, monitor, bytes);
    if (what == "kolam") return answer_kolam(request, monitor, bytes);
    if (what == "check") return answer_check(request, monitor);
    if (what == "unfit") return answer_unfit(request);
    if (what == "lines") return answer_lines(request, monitor, bytes);
    if (what == "editor") return answer_editor(request, monitor);
    if (what == "notes") return answer_notes(request, monitor, bytes);
    if (what == "affordable") return answer_affordable(request, monitor);
    if (what == "origins") return answer_origins(request, monitor);
    if (what == "import") return answer_import(request, file);
    if (what == "show") return answer_show(request, file);
    if (what == "scale") return answer_scale(request, file);
    if (what == "dots") return answer_dots(request);
    if (what == "grid") return answer_grid(request, monitor);
    if (what == "read") return answer_read(request, file, monitor, bytes);
    if (what == "command") return answer_command(request);
    if (what == "link") return answer_link(request);
    if (what == "read_link") return answer_read_link(request);
    throw BadRequest("unknown request '" + what + "'");
}

/// An answer that reports an error.
Json failure(const std::string& kind, const std::string& message, const Json& more = Json::object()) {
    Json error = {{"kind", kind}, {"message", message}};
    error.update(more);
    return {{"error", std::move(error)}};
}

Json failure_of(const std::function<Json()>& work) {
    try {
        return work();
    } catch (const PatternError& error) {
        Json more = {{"diagnostics", json_of(error.diagnostics())}};
        if (const Diagnostic* first = error.setting_error()) more["option"] = first->setting;
        return failure("pattern", error.what(), more);
    } catch (const SettingError& error) {
        return failure("setting", error.what(), {{"option", error.option()}});
    } catch (const BudgetError& error) {
        return failure("budget", error.what());
    } catch (const WordError& error) {
        return failure("word", error.what());
    } catch (const ScoreError& error) {
        return failure("score", error.what());
    } catch (const Stopped&) {
        return failure("stopped", "stopped: this takes too long");
    } catch (const BadRequest& error) {
        return failure("request", error.what());
    } catch (const JsonError& error) {
        return failure("request", error.what());
    } catch (const std::bad_alloc&) {
        return failure("other", "not enough memory");
    } catch (const std::exception& error) {
        return failure("other", error.what());
    }
}

constexpr std::size_t most_bytes = std::size_t{64} << 20;

Reply answered(const std::string& json, const std::string& bytes) {
    Reply reply;
    const Json result = failure_of([&] {
        if (json.size() > most_bytes || bytes.size() > most_bytes)
            throw BadRequest("a request can have at most 64 MB");
        const Json asked = read_json(json);
        if (!asked.is_object()) throw BadRequest("the request must be an object");
        const double seconds = number_of(asked, "seconds", 60);
        Deadline deadline{Clock::now() + std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1000))};
        return answer(asked, bytes, monitor_of(deadline), reply.bytes);
    });
    if (result.contains("error")) reply.bytes.clear();
    // Messages may quote invalid UTF-8 from patterns.
    reply.json = result.dump(-1, ' ', false, Json::error_handler_t::replace);
    return reply;
}

}  // namespace

Reply request(const std::string& json, const std::string& bytes) {
    try {
        return answered(json, bytes);
    } catch (const std::bad_alloc&) {
        return {R"({"error":{"kind":"other","message":"not enough memory"}})", {}};
    }
}

}  // namespace sikku
