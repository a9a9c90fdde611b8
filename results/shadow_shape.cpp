#include "results/shadow_shape.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/files/text_layout.h"

namespace umbrameter {

std::string missing_contacts_text(const ContactSearch& search) {
  if (search.shadowed == 0 || search.measured > 0) return {};
  if (search.distant == search.shadowed) {
    return fmt::format("no contact gap could be measured: none of the {} pixels in shadow lies beside its caster",
                       grouped(search.shadowed));
  }
  const bool have_one_reason = std::max({search.own_object, search.head_on, search.hidden}) == search.shadowed;
  std::string text = fmt::format("no contact gap could be measured: {} {} pixels in shadow",
                                 have_one_reason ? "all" : "of", grouped(search.shadowed));
  const char* separator = have_one_reason ? " " : ", ";
  const auto add = [&](std::uint64_t pixels, const char* reason) {
    if (pixels == 0) return;
    text += separator + (have_one_reason ? reason : grouped(pixels) + " " + reason);
    separator = "; ";
  };
  add(search.own_object, "are shadowed by their own object");
  add(search.head_on, "face the light head-on");
  add(search.distant, "do not lie beside their caster");
  add(search.hidden, "touch their caster, but the receiver is hidden, bends or leaves the image before the gap ends");
  return text;
}

}  // namespace umbrameter
