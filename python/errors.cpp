#include "python/errors.h"

#include "engine/base/monitor.h"
#include "engine/base/option.h"
#include "engine/derivation/derivation.h"
#include "engine/language/document.h"
#include "music/score/score.h"

#include <exception>

namespace py = pybind11;

namespace sikku {
namespace {

/// Raises an exception of `sikku.errors` by name.
template <class... Arguments>
void raise(const char* name, const Arguments&... arguments) {
    const py::object type = py::module_::import("sikku.errors").attr(name);
    const py::object error = type(arguments...);
    PyErr_SetObject(type.ptr(), error.ptr());
}

/// Raises SettingError if all errors are in settings that the caller gave, and PatternError otherwise.
void raise_pattern_error(const PatternError& error) {
    if (const Diagnostic* first = error.setting_error()) {
        return raise("SettingError", to_text(first->setting), to_text(first->value), to_text(first->message));
    }
    raise("PatternError", to_text(error.what()), to_list(error.diagnostics()));
}

void translate(const std::exception_ptr& thrown) {
    try {
        if (thrown) std::rethrow_exception(thrown);
    } catch (const py::builtin_exception&) {
        throw;
    } catch (const py::error_already_set&) {
        throw;
    } catch (const PatternError& error) {
        raise_pattern_error(error);
    } catch (const SettingError& error) {
        raise("SettingError", to_text(error.option()), to_text(error.value()), to_text(error.message()));
    } catch (const NotFound& error) {
        raise("NotFoundError", to_text(error.what()));
    } catch (const BudgetError& error) {
        raise("BudgetError", to_text(error.what()));
    } catch (const WordError& error) {
        raise("WordError", to_text(error.what()));
    } catch (const ScoreError& error) {
        raise("ScoreError", to_text(error.what()));
    } catch (const Stopped&) {
        PyErr_SetNone(PyExc_KeyboardInterrupt);
    } catch (const std::runtime_error& error) {
        raise("Error", to_text(error.what()));
    }
}

}  // namespace

py::str to_text(const std::string& bytes) {
    auto* const text = PyUnicode_DecodeUTF8(bytes.data(), static_cast<py::ssize_t>(bytes.size()), "surrogateescape");
    if (!text) throw py::error_already_set();
    return py::reinterpret_steal<py::str>(text);
}

py::list to_list(const std::vector<Diagnostic>& diagnostics) {
    const py::object type = py::module_::import("sikku.errors").attr("Diagnostic");
    py::list list;
    for (const Diagnostic& one : diagnostics) {
        list.append(type(to_text(one.file), one.where.line, one.where.column, to_text(one.message),
                         to_text(one.excerpt), one.warning));
    }
    return list;
}

void register_errors() {
    // NOLINTNEXTLINE(performance-unnecessary-value-param): pybind11 prescribes the type of translators
    py::register_local_exception_translator([](std::exception_ptr thrown) { translate(thrown); });
}

}  // namespace sikku
