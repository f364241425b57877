#include <sightline/harness/judge/grade.h>

namespace sightline::judge {

bool keeps(Contract contract, const Grade& grade) {
  return (contract == Contract::aggressive || grade.wrong_hidden.empty()) &&
         (contract == Contract::conservative || grade.wrong_visible.empty());
}

bool breaks(Contract contract, Mark mark, const Grade& grade) {
  return mark == Mark::crashed || mark == Mark::invalid || (mark == Mark::wrong && !keeps(contract, grade));
}

}  // namespace sightline::judge
