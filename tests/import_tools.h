// tests/import_tools.h: imports systems from texts, and derives the words of their patterns.
#pragma once

#include "engine/import/import.h"

#include "tests/checks.h"
#include "tests/module_reference.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sikku::import_tools {

using reference::derived_modules;
using reference::grammar_of;

std::string repeated_text(std::string_view text, int times);

SourcePointer source_of(const std::string& text, const std::string& name = "test.l");

std::string all_of(const Diagnostics& diagnostics);

std::vector<ImportedSystem> systems_of(const std::string& text);

ImportedSystem cpfg(const std::string& text, const std::string& view = "");

/// The word after n steps, or after those that the pattern states.
std::string word_of(const std::string& pattern, int n = -1, bool interpreted = false);

void expect_errors(const Diagnostics& diagnostics, const std::vector<reference::Expected>& expected);

}  // namespace sikku::import_tools
