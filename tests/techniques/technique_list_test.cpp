// The list of shadow techniques: what follows from it.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "techniques/shadow/read_parameters.h"
#include "techniques/shadow/technique.h"

namespace umbrameter {
namespace {

template <class T>
ShadowParams choosing() {
  ShadowParams params;
  params.technique = ShadowTechniques::choice<T>;
  return params;
}

TEST(TechniqueList, Every_technique_is_chosen_by_its_name_and_makes_what_it_says) {
  std::set<std::string_view> names;
  ShadowTechniques::for_each([&]<class T>(std::type_identity<T>) {
    ShadowParams params;
    require(describe(params), "shadow.technique").set_text(std::string(T::name));
    EXPECT_EQ(params.technique, ShadowTechniques::choice<T>) << T::name;
    EXPECT_TRUE(std::holds_alternative<MadeBy<T>>(make_technique(params))) << T::name;
    EXPECT_TRUE(names.insert(T::name).second) << T::name;
  });
  EXPECT_EQ(names.size(), ShadowTechniques::names.size());
}

TEST(TechniqueList, A_kind_that_several_techniques_make_is_one_alternative) {
  EXPECT_EQ(std::variant_size_v<MapTechnique>, 5u);  // PCF, what filters the map, PCSS, DPCF and screen-space shadows
  EXPECT_EQ(std::variant_size_v<ShadowTechnique>, 6u);
}

TEST(TechniqueList, Every_technique_reads_described_parameters_and_each_is_read_by_one) {
  std::set<std::string> read;
  ShadowTechniques::for_each([&]<class T>(std::type_identity<T>) {
    ShadowParams params = choosing<T>();
    params.pcf.filter = ShadowFilter::box;
    for (const Parameter& each : read_parameters(params)) {
      EXPECT_NE(find(describe(params), each.key), nullptr) << T::name << " " << each.key;
      read.insert(each.key);
    }
  });
  ShadowParams params;
  for (const auto& group : {describe(params.pcss), describe(params.esm), describe(params.moment_map),
                            describe(params.evsm), describe(params.csm_map), describe(params.map_sampling),
                            describe(params.moment_bound), describe(params.msm), describe(params.csm_lookup)}) {
    for (const Parameter& each : group) EXPECT_TRUE(read.contains(each.key)) << each.key;
  }
}

TEST(TechniqueList, A_map_and_its_look_ups_read_different_parameters) {
  ShadowTechniques::for_each([&]<class T>(std::type_identity<T>) {
    ShadowParams params = choosing<T>();
    const Parameters of_map = filtered_map_parameters(params);
    for (const Parameter& each : lookup_parameters(params)) {
      EXPECT_EQ(find(of_map, each.key), nullptr) << T::name << " " << each.key;
    }
    EXPECT_EQ(lookup_parameters(params).empty(), !FiltersMap<T>) << T::name;
  });
}

}  // namespace
}  // namespace umbrameter
