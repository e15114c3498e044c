#include "cli/mistakes.h"

#include "cli/command.h"
#include "cli/link_argument.h"
#include "engine/base/diagnostic.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <system_error>

namespace sikku {
namespace {

/// The command that is used, or the program itself.
const CLI::App& used_command(const CLI::App& app) {
    const auto used = app.get_subcommands();
    return used.empty() ? app : *used.back();
}

/// Brackets around the value in the table: it may be left out.
bool has_optional_value(const CLI::Option& option) {
    return option.get_type_name().starts_with('[');
}

std::string unknown_option(const CLI::App& command, const std::string& argument) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    const std::string given = argument.substr(0, argument.find('='));
    std::string_view near = nearest(given, {names.begin(), names.end()});
    // Synonyms of options.
    constexpr std::array<std::array<std::string_view, 2>, 12> words = {{{"--tile-overlap", "--overlap"},
                                                                        {"--colour", "--stroke"},
                                                                        {"--color", "--stroke"},
                                                                        {"--bpm", "--tempo"},
                                                                        {"--paper", "--size"},
                                                                        {"--paper-size", "--size"},
                                                                        {"--page", "--size"},
                                                                        {"--page-size", "--size"},
                                                                        {"--background", "--ground"},
                                                                        {"--resolution", "--dpi"},
                                                                        {"--output", "-o"},
                                                                        {"--iterations", "-n"}}};
    for (const auto& [word, name] : words) {
        if (word == given && command.get_option_no_throw(std::string(name))) near = name;
    }
    const std::string name = command.get_parent() ? command.get_name() + " " : "";
    return fmt::format("unknown option '{}'{}", printable(given, 80),
                       near.empty() ? fmt::format("; `sikku {}--help` lists the options", name)
                                    : fmt::format("; did you mean '{}'?", near));
}

/// An argument that no option or positional takes.
std::string unexpected(const CLI::App& command, const std::string& argument,
                       const std::vector<std::string>& arguments) {
    std::string message = "unexpected argument '" + printable(argument, 80) + "'";
    const auto at =
        static_cast<std::size_t>(std::find(arguments.begin(), arguments.end(), argument) - arguments.begin());
    if (at < 2 || at == arguments.size()) return message;
    const std::string& name = arguments[at - 2];
    const CLI::Option* option = name.starts_with("--") ? command.get_option_no_throw(name) : nullptr;
    if (!option || option->get_type_name().find_first_of(" V") == std::string::npos) return message;
    return fmt::format("{}; quote a value with blanks: {}='{} {}'", message, name, printable(arguments[at - 1], 80),
                       printable(argument, 80));
}

/// The error in a name of a pattern, which is reported before a missing option; empty if there is none. Opens no
/// file.
std::string mistake_in_pattern(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options()) {
        const std::string name = option->get_name();
        if (name != "PATTERN" && name != "DRAWING") continue;
        for (const std::string& given : option->results()) {
            try {
                if (given == "-" || is_link(given)) continue;
                const bool has_settings = name == "DRAWING" && !std::filesystem::exists(given);  // PATTERN@SETTINGS
                find_named_pattern(has_settings ? given.substr(0, given.rfind('@')) : given);
            } catch (const UsageError& error) {
                return error.what();
            } catch (const std::exception&) {
                // The command reports it.
            }
        }
    }
    return {};
}

std::string missing(const CLI::App& app, const CLI::App& command) {
    const std::string how = fmt::format("; `sikku {} --help` shows how", command.get_name());
    for (const CLI::Option* option : command.get_options()) {
        if (!option->get_required() || option->count() > 0) continue;
        const std::string name = option->get_name();
        if (!option->get_positional()) {
            std::string mistake = mistake_in_pattern(command);
            return mistake.empty() ? fmt::format("{} {} is missing{}", name, option->get_type_name(), how) : mistake;
        }
        for (const CLI::Option* taker : command.get_options()) {
            if (!has_optional_value(*taker) || taker->results().empty() || taker->results().front().empty()) continue;
            return fmt::format("{0} is missing: '{1}' was read as the value of {2}; put {0} first, or write {2}=…",
                               name, printable(taker->results().front(), 80), taker->get_name());
        }
        return fmt::format("{} is missing{}", name, how);
    }
    return &command == &app ? "a command is missing; `sikku --help` lists them" : "something is missing" + how;
}

}  // namespace

void check_arguments(const CLI::App& app, const std::vector<std::string>& arguments) {
    if (arguments.empty() || arguments[0].starts_with('-')) return;
    std::vector<std::string_view> names = {"--version", "--help"};
    const CLI::App* command = nullptr;
    for (const CLI::App* one : app.get_subcommands({})) {
        names.push_back(one->get_name());
        if (names.back() == arguments[0]) command = one;
    }
    if (!command) {
        const std::string_view near = nearest(arguments[0], names);
        throw UsageError(
            fmt::format("unknown command '{}'{}", printable(arguments[0], 80),
                        near.empty() ? "; `sikku --help` lists them" : fmt::format("; did you mean '{}'?", near)));
    }
    const auto option_of = [&](const std::string& name) -> const CLI::Option* {
        if (name.size() < 2 || name[0] != '-') return nullptr;
        const CLI::Option* own = command->get_option_no_throw(name);
        return own ? own : app.get_option_no_throw(name);
    };
    for (std::size_t i = 1; i < arguments.size() && arguments[i] != "--"; ++i) {
        const CLI::Option* option = option_of(arguments[i]);
        if (!option || option->get_expected_max() == 0) continue;
        const std::string next = i + 1 < arguments.size() ? arguments[i + 1] : "--";
        const bool is_option = next == "--" || option_of(next) || option_of(next.substr(0, next.find('=')));
        if (has_optional_value(*option)) {
            if (is_option || !next.starts_with("-") || next == "-") continue;
            if (next.starts_with("--")) throw UsageError(unknown_option(*command, next));
            throw UsageError(fmt::format("unknown option '{0}'; a value that begins with '-' is written {1}={0}",
                                         printable(next, 80), arguments[i]));
        } else if (is_option) {
            throw UsageError(fmt::format("{} needs a value: {}", arguments[i], option->get_type_name()));
        }
    }
}

std::string parse_message(const CLI::App& app, const CLI::ParseError& error,
                          const std::vector<std::string>& arguments) {
    const CLI::App& command = used_command(app);
    const bool is_incomplete = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
    if (is_incomplete || dynamic_cast<const CLI::ExtrasError*>(&error)) {
        const std::vector<std::string> extras = app.remaining(true);
        // The value of an unknown option stands before it in this list.
        const auto option = std::find_if(extras.begin(), extras.end(), [](const std::string& text) {
            return text.starts_with("-") && text != "-";
        });
        if (option != extras.end()) return unknown_option(command, *option);
        return is_incomplete ? missing(app, command) : unexpected(command, extras.front(), arguments);
    }
    for (const CLI::Option* option : command.get_options()) {
        if (option->count() == 0) continue;
        const std::string name = option->get_name();
        if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) {
            const int most = std::max(option->get_items_expected_max(), 1);
            if (option->results().size() > static_cast<std::size_t>(most)) return name + " is given twice";
        }
        if (dynamic_cast<const CLI::RequiresError*>(&error)) {
            for (const CLI::Option* need : option->get_needs()) {
                if (need->count() == 0) return fmt::format("{} needs {}", name, need->get_name());
            }
        }
        if (dynamic_cast<const CLI::ExcludesError*>(&error)) {
            for (const CLI::Option* other : option->get_excludes()) {
                if (other->count() > 0) return fmt::format("{} cannot be combined with {}", name, other->get_name());
            }
        }
    }
    return error.what();
}

Check whole_number(std::int64_t least, std::int64_t most) {
    return [least, most](const std::string& text) {
        std::int64_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool is_whole = error == std::errc() && end == text.data() + text.size();
        if (is_whole && value >= least && value <= most) return std::string();
        return fmt::format("expected a whole number from {} to {}, not '{}'", least, most, printable(text, 80));
    };
}

Check number_between(double least, double most) {
    return [least, most](const std::string& text) {
        double value = 0;
        if (read_number(text, value) && value >= least && value <= most) return std::string();
        return fmt::format("expected a number from {:g} to {:g}, not '{}'", least, most, printable(text, 80));
    };
}

std::string above_zero(const std::string& text) {
    double value = 0;
    return read_number(text, value) && value > 0 ? "" : "expected a number above 0, not " + printable(text);
}

Check one_of(std::vector<std::string> words) {
    return [words = std::move(words)](const std::string& text) {
        if (std::find(words.begin(), words.end(), text) != words.end()) return std::string();
        const std::vector<std::string_view> all(words.begin(), words.end());
        return fmt::format("expected {}, not '{}'", alternatives(all), printable(text, 80));
    };
}

}  // namespace sikku
