#include <sightline/algorithms/image/weiler_atherton.h>

namespace sightline {

template Visible_surface<Exact_view> weiler_atherton(const Exact_view&, Cones<Exact_view>, const Visible_options&);
template Visible_surface<Number_view<double>> weiler_atherton(const Number_view<double>&, Cones<Number_view<double>>,
                                                              const Visible_options&);
template Visible_surface<Number_view<float>> weiler_atherton(const Number_view<float>&, Cones<Number_view<float>>,
                                                             const Visible_options&);

}  // namespace sightline
