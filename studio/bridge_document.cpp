// studio/bridge_document.cpp: requests about a pattern: facts, pictures, and files of other programs.
#include "art/analysis.h"
#include "art/prints.h"
#include "art/product/draw_settings.h"
#include "art/product/unused_options.h"
#include "art/provenance/provenance.h"
#include "engine/base/text.h"
#include "engine/check.h"
#include "engine/derivation/forecast.h"
#include "engine/derivation/origins.h"
#include "engine/import/import.h"
#include "engine/language/foreign_text.h"
#include "engine/map/map_step.h"
#include "engine/measure/extent.h"
#include "music/scale/scale.h"
#include "music/score/midi_texts.h"
#include "music/scores.h"
#include "studio/bridge_answers.h"
#include "studio/editor/measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <utility>
#include <variant>

namespace sikku {

const Interpreter& interpreter_of(const Json& request) {
    const std::string name = text_of(request, "interpreter");
    if (name == "draw") return prints();
    if (name == "play") return scores();
    throw BadRequest("'interpreter' must be 'draw' or 'play'");
}

OptionValues options_of(const Json& request) {
    OptionValues values;
    for (auto& [name, text] : pairs_of(request, "options")) values.push_back({name, text});
    return values;
}

Document document_of(const Json& request) {
    struct Kept {
        Json pattern;
        Document document;
    };
    static std::deque<Kept> kept;
    constexpr std::size_t most = 16;
    constexpr std::size_t largest = std::size_t{1} << 22;  // longer patterns are not cached
    const Json& pattern = member(request, "pattern");
    const auto found =
        std::find_if(kept.begin(), kept.end(), [&](const Kept& each) { return each.pattern == pattern; });
    if (found != kept.end()) return found->document;
    Overrides overrides{text_of(pattern, "variant", ""), {}};
    for (auto& [name, text] : pairs_of(pattern, "settings")) overrides.settings.emplace_back(name, text);
    const std::array<const Interpreter*, 2> interpreters = {&prints(), &scores()};
    Diagnostics diagnostics;
    Document document =
        compile(text_of(pattern, "name"), text_of(pattern, "text"), overrides, interpreters, diagnostics);
    diagnostics.throw_if_errors();
    if (document.source().text().size() <= largest) kept.push_front({pattern, document});
    if (kept.size() > most) kept.pop_back();
    return document;
}

std::string output_name(const Document& document, const std::string& format) {
    return std::filesystem::path(document.source().name()).stem().string() + "." + format;
}

Json json_of(const std::vector<Remark>& remarks) {
    Json list = Json::array();
    for (const Remark& remark : remarks) list.push_back({{"is_warning", remark.is_warning}, {"text", remark.text}});
    return list;
}

Json json_of(const std::vector<Diagnostic>& diagnostics) {
    Json list = Json::array();
    for (const Diagnostic& diagnostic : diagnostics) {
        Json one = {{"line", diagnostic.where.line},
                    {"column", diagnostic.where.column},
                    {"message", diagnostic.message},
                    {"warning", diagnostic.warning}};
        if (diagnostic.where.line == 0) one["setting"] = diagnostic.file;
        list.push_back(std::move(one));
    }
    return list;
}

// --- facts ------------------------------------------------------------------------------------------------------

namespace {

/// The line of a place in the text of the pattern; 0 in a setting.
int line_of(const Document& document, const Span& span) {
    return span.source == &document.source() ? document.source().place(span.at).line : 0;
}

Json keys_of(const Document& document) {
    Json list = Json::array();
    for (const Key& key : document.pattern().keys) {
        list.push_back({{"name", key.name}, {"value", key.value.view()}, {"line", line_of(document, key.name_at)}});
    }
    return list;
}

Json defines_of(const Document& document) {
    Json list = Json::array();
    for (const Define& define : document.pattern().defines) {
        list.push_back(
            {{"name", define.name.view()}, {"value", define.value.view()}, {"line", line_of(document, define.name)}});
    }
    return list;
}

void append_productions(const Document& document, const std::vector<ProductionText>& productions,
                        std::string_view table, Json& list) {
    for (const ProductionText& production : productions) {
        const Place place = document.source().place(production.whole.at);
        list.push_back({{"line", place.line},
                        {"column", place.column},
                        {"length", production.whole.length},
                        {"predecessor", production.predecessor.view()},
                        {"successor", production.successor.view()},
                        {"table", table}});
    }
}

Json productions_of(const Document& document) {
    const Pattern& pattern = document.pattern();
    Json list = Json::array();
    append_productions(document, pattern.common, "", list);
    for (const TableText& table : pattern.tables)
        append_productions(document, table.productions, table.name.view(), list);
    append_productions(document, pattern.interpret, "interpret", list);
    return list;
}

/// Adds the length of the word, the number of segments and the extent, if they are cheap to compute.
void add_measures(const Document& document, const Monitor& monitor, Json& answer) {
    const QuickMeasures measures = measure_quickly(document, monitor);
    answer["cost"] = {{"symbols", measures.symbols},
                      {"cells", measures.cells},
                      {"edges", measures.edges},
                      {"segments", measures.segments},
                      {"is_derivable", measures.is_derivable},
                      {"most", measures.most}};
    if (measures.extent) answer["extent"] = *measures.extent;
}

/// Warnings, and errors of the word.
Json warnings_of(const Document& document) {
    Diagnostics diagnostics;
    check_brackets(document.pattern(), document.grammar(), diagnostics);
    Json list = json_of(document.warnings());
    for (Json& error : json_of(diagnostics.list())) list.push_back(std::move(error));
    return list;
}

}  // namespace

Json answer_open(const Json& request, const Monitor& monitor) {
    const Document document = document_of(request);
    Json variants = Json::array();
    for (const Variant& variant : document.pattern().variants) variants.push_back(variant.name.view());
    Json answer = {{"title", document.text("title")},
                   {"source", document.text("source")},
                   {"n", fmt::format("{}", document.grammar().steps())},
                   {"seed", fmt::format("{}", document.grammar().seed())},
                   {"variants", std::move(variants)},
                   {"defines", defines_of(document)},
                   {"keys", keys_of(document)},
                   {"productions", productions_of(document)},
                   {"warnings", warnings_of(document)},
                   {"is_melody", sets_keys_of(scores(), document)},
                   {"is_spatial", document.grammar().is_spatial()},
                   {"is_map", document.map() != nullptr},
                   {"is_random", document.grammar().is_stochastic()},
                   {"has_view", has_view(document)}};
    add_measures(document, monitor, answer);
    return answer;
}

namespace {

/// True if the word of a derivation length has at most `most` nodes, counted by deriving if need be.
bool is_short(const Document& document, std::int64_t steps, double most, const Monitor& monitor) {
    try {
        const Document shorter = document.with({{"derivation length", fmt::format("{}", steps)}});
        measure(shorter.grammar(), most, [&](std::uint64_t symbols) { monitor.advance(symbols); });
        return true;
    } catch (const BudgetError&) {
        return false;
    }
}

/// The largest number of steps of a map whose edges are at most `most` together; -1 with a schedule, by which a
/// shorter derivation has other steps.
std::int64_t largest_map(const Document& document, double most, const Monitor& monitor) {
    if (document.grammar().has_schedule()) return -1;
    // Without a limit of edges, which is compared with all steps at once before the first is made.
    constexpr double most_memory = 1e9;
    MapDerivation derivation(document.grammar(), {std::numeric_limits<double>::infinity(), most_memory}, monitor);
    double edges = 0;
    try {
        while (derivation.next()) {
            edges += static_cast<double>(derivation.map().edges().size());
            if (edges > most) return derivation.steps() - 1;
        }
    } catch (const Stopped&) {  // the steps that were made in time fit
    } catch (const BudgetError&) {
    }
    return derivation.steps();
}

}  // namespace

Json answer_affordable(const Json& request, const Monitor& monitor) {
    constexpr double most = 3e7;          // nodes that are drawn within a few seconds
    constexpr double nodes_of_edge = 10;  // of maps
    const Document document = document_of(request);
    const Grammar& grammar = document.grammar();
    const auto now = static_cast<std::int64_t>(grammar.steps());
    std::int64_t fits = -1;
    const auto expected = document.map() ? std::nullopt : estimate(grammar, true);
    if (expected) {
        fits = largest_affordable(grammar, true, most);
    } else if (document.map()) {
        fits = largest_map(document, most / nodes_of_edge, monitor);
    } else {
        try {
            while (fits < now && is_short(document, fits + 1, most, monitor)) ++fits;
        } catch (const Stopped&) {  // the lengths that were derived in time fit
        } catch (const std::runtime_error&) {
        }
    }
    // The derivation takes too long although its word is short.
    if (fits >= now) fits = now - 1;
    return {{"n", fits < 0 ? "" : fmt::format("{}", fits)}};
}

namespace {

Json json_of(const Document& document, const Span& span) {
    if (span.source != &document.source()) return {{"line", 0}, {"column", 0}, {"length", 0}};
    const Place place = document.source().place(span.at);
    std::size_t length = 0;  // in code points, as columns are
    for (std::string_view rest = span.view(); !rest.empty(); ++length) {
        rest.remove_prefix(std::max<std::size_t>(utf8_length(rest), 1));
    }
    return {{"line", place.line}, {"column", place.column}, {"length", length}};
}

}  // namespace

Json answer_origins(const Json& request, const Monitor& monitor) {
    constexpr std::size_t most = 10'000;
    const Document document = document_of(request);
    const Json& symbols = member(request, "symbols");
    if (!symbols.is_array() || symbols.size() > most) {
        throw BadRequest(fmt::format("'symbols' must be a list of at most {} positions", most));
    }
    std::vector<std::uint64_t> positions;
    for (const Json& symbol : symbols) positions.push_back(whole_of(symbol, "symbols"));
    Json list = Json::array();
    for (const Origin& origin : origins(document, positions, monitor)) {
        if (origin.symbol.empty()) {
            list.push_back(nullptr);
            continue;
        }
        Json place = json_of(document, origin.symbol);
        place["production"] = origin.production.empty() ? Json(nullptr) : json_of(document, origin.production);
        list.push_back(std::move(place));
    }
    return {{"origins", std::move(list)}};
}

// --- pictures ---------------------------------------------------------------------------------------------------

namespace {

/// Selects the options that affect the look of a drawing and, for the whole page, its layout.
OptionValues shown_options(const OptionValues& all, bool is_page) {
    OptionValues shown;
    for (const OptionValue& value : all) {
        const OptionInfo* option = find_option(prints().options(), value.name);
        switch (option ? option->scope : Scope::look) {
            case Scope::look:
            case Scope::turn:
            case Scope::space:
            case Scope::kolam:
            case Scope::cost:
                shown.push_back(value);
                break;
            case Scope::page:
            case Scope::framing:
            case Scope::place:
            case Scope::scale:
            case Scope::extras:
            case Scope::copies:
                if (is_page) shown.push_back(value);
                break;
            default:
                break;
        }
    }
    return shown;
}

constexpr double most_side = 16'384;
constexpr double most_pixels = 40e6;
constexpr double dpi_of_css = 96;
constexpr double mm_of_inch = 25.4;

}  // namespace

Json answer_pixels(const Json& request, const Monitor& monitor, std::string& bytes) {
    const Document document = document_of(request);
    const double width = number_of(request, "width", 0);
    const double height = number_of(request, "height", 0);
    if (!(width >= 1 && height >= 1 && width <= most_side && height <= most_side && width * height <= most_pixels)) {
        throw BadRequest("'width' and 'height' must be 1 to 16384, with at most 40 million pixels in all");
    }
    const bool is_window = request.contains("window");
    OptionValues values = shown_options(options_of(request), !is_window);
    if (is_window) {
        const double dpi = dpi_of_css * number_of(request, "ratio", 1);
        std::string window;
        for (const Json& side : request["window"]) {
            if (!side.is_string()) throw BadRequest("'window' must be four strings");
            window += (window.empty() ? "" : ",") + side.get<std::string>();
        }
        const auto millimetres = [&](double pixels) {
            return fmt::format("{}", std::round(pixels) * mm_of_inch / dpi);
        };
        values.push_back({"size", millimetres(width) + "x" + millimetres(height) + "mm"});
        values.push_back({"margin", "0mm"});
        values.push_back({"dpi", fmt::format("{}", dpi)});
        values.push_back({"window", window});
    } else {
        OptionValues own;  // without keys and defines of the pattern
        std::copy_if(values.begin(), values.end(), std::back_inserter(own),
                     [](const OptionValue& value) { return find_option(prints().options(), value.name) != nullptr; });
        const Page page = read_draw_settings(own).paper.page;
        const double dpi = std::min(width / page.width, height / page.height) * mm_of_inch;
        values.push_back({"dpi", fmt::format("{}", std::clamp(dpi, 1.0, 10'000.0))});
    }
    const DrawnPixels pixels = draw_pixels(document, values, monitor);
    bytes.assign(reinterpret_cast<const char*>(pixels.bytes.data()), pixels.bytes.size());
    return {{"width", pixels.width}, {"height", pixels.height}, {"remarks", json_of(pixels.remarks)}};
}

// --- files ------------------------------------------------------------------------------------------------------

Json answer_import(const Json& request, const std::string& file) {
    const auto source = std::make_shared<const Source>(text_of(request, "name"), file);
    const std::string view_text = text_of(request, "view", "");
    const SourcePointer view = view_text.empty() ? nullptr : std::make_shared<const Source>("view", view_text);
    const auto format = import_format(file);
    if (!format) {
        const ForeignKind kind = foreign_kind(file);
        const bool is_named = kind == ForeignKind::lpfg || kind == ForeignKind::lpy;
        throw std::runtime_error(fmt::format(
            "{}: {}", source->name(),
            is_named
                ? fmt::format("this is {}; only files of cpfg and Fractint can be imported", foreign_kind_name(kind))
                : "neither a cpfg file nor a Fractint collection"));
    }
    Diagnostics diagnostics;
    const auto systems =
        *format == ImportFormat::cpfg ? import_cpfg(source, view, diagnostics) : import_fractint(source, diagnostics);
    Json list = Json::array();
    for (const ImportedSystem& system : systems) {
        list.push_back({{"name", import_file_name(system.name)},
                        {"line", system.line},
                        {"text", system.pattern},
                        {"draws", system.draws},
                        {"losses", system.losses}});
    }
    return {{"systems", std::move(list)}, {"diagnostics", json_of(diagnostics.sorted())}};
}

Json answer_scale(const Json& request, const std::string& file) {
    const std::string name = text_of(request, "name");
    const std::string lower = lower_case(name);
    const bool is_map = lower.ends_with(".kbm");
    if ((!is_map && !lower.ends_with(".scl")) || name.find_first_of("/\\:") != std::string::npos || name[0] == '.') {
        throw BadRequest("expected the name of a .scl or .kbm file");
    }
    const Source source(name, file);
    Diagnostics diagnostics;
    if (is_map) {
        read_kbm(source, diagnostics);
    } else {
        read_scl(source, diagnostics);
    }
    diagnostics.throw_if_errors();
    std::ofstream stream(name, std::ios::binary);
    stream.write(file.data(), static_cast<std::streamsize>(file.size()));
    if (!stream.flush()) throw std::runtime_error(name + ": cannot be kept");
    return {{"name", name}};
}

Json answer_show(const Json& request, const std::string& file) {
    // The name does not matter: formats are recognised by their first bytes.
    MemoryOutput output;
    output.write(file);
    const std::filesystem::path path = output.temporary();
    const std::string name = text_of(request, "name");
    std::optional<Provenance> found;
    try {
        found = read_provenance(path);
    } catch (const std::runtime_error& error) {
        std::string message = error.what();  // about the temporary file
        if (const std::size_t at = message.find(path.string()); at != std::string::npos) {
            message.replace(at, path.string().size(), printable(name));
        }
        throw std::runtime_error(message);
    }
    if (!found && is_midi_file(path)) {
        MidiTexts texts = read_midi_texts({reinterpret_cast<const std::uint8_t*>(file.data()), file.size()});
        if (!texts.pattern.empty()) found = Provenance{std::move(texts.pattern), std::move(texts.made)};
    }
    if (!found) throw std::runtime_error(printable(name) + ": this file contains no pattern");
    return {{"text", found->pattern}, {"made", found->made}};
}

Json answer_unfit(const Json& request) {
    const auto format = named_format(text_of(request, "format"));
    if (!format) throw BadRequest("unknown format");
    const Document document = document_of(request);
    const OptionValues all = options_of(request);
    OptionValues own;  // without keys and defines of the pattern
    std::copy_if(all.begin(), all.end(), std::back_inserter(own),
                 [](const OptionValue& value) { return find_option(prints().options(), value.name) != nullptr; });
    const DrawSettings settings = read_draw_settings(own);
    const bool is_map = document.map() != nullptr;
    std::set<std::string> names = options_without_effect(document, settings, *format);
    for (const std::string_view name : refused_options(settings, *format, document.grammar().is_spatial(), is_map)) {
        names.emplace(name);
    }
    return {{"options", names}};
}

Json answer_lines(const Json& request, const Monitor& monitor, std::string& bytes) {
    constexpr double budget = 3e6;
    constexpr std::size_t most_points = 400'000;
    const DrawnLines lines = drawn_lines(document_of(request), budget, monitor);
    const auto* plane = std::get_if<Polylines<glm::dvec2>>(&lines);
    if (!plane) throw BadRequest("lines in space have no picture in the plane");
    if (plane->points.size() > most_points) throw BudgetError(fmt::format("more than {} points", most_points));
    bytes.assign(reinterpret_cast<const char*>(plane->points.data()), plane->points.size() * sizeof(glm::dvec2));
    return {{"begins", plane->begins}};
}

namespace {

/// A file of that name rather than an option.
std::string quoted_file(const std::string& name) {
    return shell_word(name.starts_with('-') ? "./" + name : name);
}

}  // namespace

Json answer_command(const Json& request) {
    const Json& pattern = member(request, "pattern");
    const Interpreter& interpreter = interpreter_of(request);
    const std::string format = text_of(request, "format");
    if (!find_format(interpreter.formats(), format)) refuse_option("format", format, "unknown format");
    const std::string name = text_of(pattern, "name");
    const std::string source = text_of(request, "source", name);
    std::string command = "sikku " + text_of(request, "interpreter") + " " + quoted_file(source);
    const std::string variant = text_of(pattern, "variant", "");
    if (!variant.empty()) command += " --variant " + shell_word(variant);
    for (const auto& [key, value] : pairs_of(pattern, "settings")) {
        if (key == "derivation length") {
            command += " -n " + shell_word(value);
        } else if (key == "seed") {
            command += " --seed " + shell_word(value);
        } else {
            command += fmt::format(" --set {}", shell_word(fmt::format("{}={}", key, value)));
        }
    }
    for (const OptionValue& value : options_of(request)) {
        const OptionInfo* option = find_option(interpreter.options(), value.name);
        if (!option) {  // a key or a define of the pattern
            command += fmt::format(" --set {}", shell_word(fmt::format("{}={}", value.name, value.text)));
        } else {
            command += on_command_line(*option, value.text);
        }
    }
    const std::string stem = std::filesystem::path(name).stem().string();
    return {{"command", command + " -o " + quoted_file(stem + "." + format)}};
}

}  // namespace sikku
