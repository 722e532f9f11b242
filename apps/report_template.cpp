// The report's page, put into the executable as it is at build time. The assembler reads the file:
// a page of megabytes as a C++ literal would take minutes to compile.

#include "apps/report.hpp"

asm(R"(
  .pushsection .rodata
  .global harpoon_report_template
  .global harpoon_report_template_end
harpoon_report_template:
  .incbin ")" HARPOON_REPORT_TEMPLATE R"("
harpoon_report_template_end:
  .byte 0
  .popsection
)");

extern const char kTemplateBegin[] asm("harpoon_report_template");
extern const char kTemplateEnd[] asm("harpoon_report_template_end");

namespace harpoon::app {

std::string_view report_template() {
  return {kTemplateBegin, static_cast<std::size_t>(kTemplateEnd - kTemplateBegin)};
}

}  // namespace harpoon::app
