#include <sightline/harness/judge/grade.h>

namespace sightline::judge {

bool keeps(Contract contract, const Grade& grade) {
  switch (contract) {
    case Contract::exact: return !grade.wrong();
    case Contract::conservative: return grade.wrong_hidden.empty() && !grade.too_small();
    case Contract::aggressive: return grade.wrong_visible.empty() && !grade.too_large();
  }
  return false;
}

bool breaks(Contract contract, Mark mark, const Grade& grade) {
  return mark == Mark::crashed || mark == Mark::invalid || (mark == Mark::wrong && !keeps(contract, grade));
}

}  // namespace sightline::judge
