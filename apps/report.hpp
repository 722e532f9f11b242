#pragma once

// report.html: the page template that is embedded in the executable, with the data put in.

#include <string>
#include <string_view>

#include "apps/claims.hpp"
#include "apps/experiment.hpp"
#include "bench/json.hpp"

namespace harpoon::app {

/// The page without data, as built from web/. Static storage.
std::string_view report_template();

/// The data of the page (schema 2).
bench::Json report_data(const Experiment& experiment, const bench::ResultSet& results);

/// The page: `data` takes the place of `null` in the template's harpoon-data element, with every
/// `<` escaped, so that no text in it can end the element. Throws CommandError when the template
/// has no such element.
std::string fill_template(std::string_view page, const bench::Json& data);

}  // namespace harpoon::app
