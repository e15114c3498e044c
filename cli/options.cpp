#include "cli/options.h"

#include "cli/command.h"

#include <fmt/format.h>

#include <algorithm>

namespace sikku {

void TableOptions::add(CLI::App& command, std::span<const OptionInfo* const> table) {
    for (const OptionInfo* info : table) {
        const std::string name(info->name);
        if (command.get_option_no_throw("--" + name)) continue;
        auto one = std::make_unique<One>();
        one->info = info;
        std::string names = "--" + name;
        if (info->letter != 0) names = fmt::format("-{},{}", info->letter, names);
        if (info->kind == OptionKind::flag) {
            if (info->is_on) names += ",!--no-" + name;
            one->option = command.add_flag(names, one->flag, with_dashes(std::string(info->help)));
        } else {
            one->option = command.add_option(names, one->texts, with_dashes(std::string(info->help)));
            // Brackets mark an optional value.
            one->option->expected(info->value.starts_with('[') ? 0 : 1, info->is_list ? 1'000 : 1);
            one->option->allow_extra_args(false);
            one->option->multi_option_policy(info->is_list ? CLI::MultiOptionPolicy::TakeAll
                                                           : CLI::MultiOptionPolicy::Throw);
            one->option->type_name(std::string(info->value));
        }
        if (!info->group.empty()) one->option->group(std::string(info->group));
        given_->push_back(std::move(one));
    }
}

OptionValues TableOptions::values() const {
    OptionValues values;
    for (const auto& one : *given_) {
        if (one->option->count() == 0) continue;
        const std::string name(one->info->name);
        if (one->info->kind == OptionKind::flag) {
            values.push_back({name, one->flag ? "true" : "false"});
        } else if (one->texts.empty()) {
            values.push_back({name, ""});
        } else {
            for (const std::string& text : one->texts) values.push_back({name, text});
        }
    }
    return values;
}

namespace {

bool is_option(std::string_view name) {
    const auto all = interpreters();
    return std::any_of(all.begin(), all.end(),
                       [&](const Interpreter* one) { return find_option(one->options(), name) != nullptr; });
}

}  // namespace

std::string with_dashes(const std::string& message) {
    std::string text;
    for (std::size_t at = 0; at < message.size();) {
        const std::size_t close = message[at] == '\'' ? message.find('\'', at + 1) : std::string::npos;
        const std::string name = close == std::string::npos ? "" : message.substr(at + 1, close - at - 1);
        if (is_option(name)) {
            text += "--" + name;
            at = close + 1;
        } else {
            text += message[at++];
        }
    }
    return text;
}

std::string with_force(std::string message) {
    using Replacement = std::pair<std::string_view, std::string_view>;
    for (const auto& [quoted, option] :
         {Replacement("'force'", "--force"), Replacement("'name' sets another", "--name sets another")}) {
        if (const std::size_t at = message.find(quoted); at != std::string::npos) {
            message.replace(at, quoted.size(), option);
        }
    }
    return message;
}

std::string diagnostic_message(const Diagnostic& diagnostic) {
    if (diagnostic.where.line > 0) return (diagnostic.file.starts_with("--") ? "sikku: " : "") + diagnostic.text();
    // A value from the command line.
    return (diagnostic.file.starts_with('-') ? "sikku: " : "sikku: --") + diagnostic.text();
}

std::string pattern_message(const PatternError& error) {
    const auto& list = error.diagnostics();
    std::string text;
    for (const Diagnostic& one : list) text += (text.empty() ? "" : "\n") + diagnostic_message(one);
    return text;
}

std::string option_message(const SettingError& error) {
    std::string message = with_dashes(error.message());
    if (error.option().empty()) return message;
    const std::string value = error.value().empty() ? "" : " " + printable(error.value(), 80);
    return fmt::format("--{}{}: {}", error.option(), value, message);
}

}  // namespace sikku
