#pragma once
// Which header of the standard library has a name, so that what is compiled with all of them precompiled still includes
// what it uses.

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace include_rules {

/// Headers, and names that each of them has.
inline const std::vector<std::pair<std::string_view, std::string_view>> names_of_headers{
    {"algorithm",
     "adjacent_find all_of any_of binary_search clamp copy copy_if copy_n count count_if equal equal_range fill "
     "fill_n find find_first_of find_if find_if_not for_each generate includes inplace_merge is_permutation "
     "is_sorted is_sorted_until iter_swap lexicographical_compare lexicographical_compare_three_way lower_bound "
     "make_heap max max_element merge min min_element minmax minmax_element mismatch move_backward "
     "next_permutation none_of nth_element partial_sort partition partition_point pop_heap prev_permutation "
     "push_heap ranges remove remove_copy_if remove_if replace replace_if reverse reverse_copy rotate rotate_copy "
     "search set_difference set_intersection set_symmetric_difference set_union shuffle sort sort_heap "
     "stable_partition stable_sort swap_ranges transform unique unique_copy upper_bound"},
    {"array", "array begin data end get size to_array tuple_element tuple_size tuple_size_v"},
    {"atomic",
     "atomic atomic_flag atomic_ref memory_order memory_order_acq_rel memory_order_acquire memory_order_relaxed "
     "memory_order_release memory_order_seq_cst"},
    {"bit",
     "bit_cast bit_ceil bit_floor bit_width countl_one countl_zero countr_one countr_zero endian has_single_bit "
     "popcount rotl rotr"},
    {"bitset", "bitset"},
    {"cctype", "isalnum isalpha isdigit isprint isspace isupper isxdigit tolower toupper"},
    {"cerrno", "errno"},
    {"charconv", "chars_format from_chars to_chars"},
    {"chrono", "chrono"},
    {"cmath",
     "abs acos asin atan atan2 cbrt ceil copysign cos double_t exp exp2 fabs float_t floor fma fmax fmin fmod "
     "fpclassify frexp hypot ilogb isfinite isinf isnan isnormal ldexp llround log log10 log2 logb lrint lround "
     "modf nan nearbyint nextafter nexttoward pow remainder rint round scalbn signbit sin sqrt tan trunc"},
    {"compare", "compare_three_way partial_ordering strong_ordering weak_ordering"},
    {"concepts",
     "constructible_from convertible_to copyable default_initializable derived_from equality_comparable "
     "floating_point integral invocable predicate regular same_as signed_integral totally_ordered "
     "unsigned_integral"},
    {"condition_variable", "condition_variable condition_variable_any"},
    {"csignal", "raise signal"},
    {"cstddef", "byte max_align_t nullptr_t ptrdiff_t size_t"},
    {"cstdint",
     "int16_t int32_t int64_t int8_t intmax_t intptr_t uint16_t uint32_t uint64_t uint8_t uintmax_t uintptr_t"},
    {"cstdio", "FILE fclose feof ferror fflush fgetc fopen fprintf fputs fread fwrite printf remove rename snprintf"},
    {"cstdlib", "abort abs atof atoi exit free getenv labs llabs malloc strtod strtol strtoul system"},
    {"cstring", "memchr memcmp memcpy memmove memset strchr strcmp strcpy strerror strlen"},
    {"ctime", "clock clock_t time time_t"},
    {"deque", "deque erase_if"},
    {"exception",
     "current_exception exception exception_ptr make_exception_ptr nested_exception rethrow_exception terminate "
     "uncaught_exceptions"},
    {"filesystem", "filesystem"},
    {"fstream", "filebuf fstream ifstream ofstream"},
    {"functional",
     "bit_and bit_or bit_xor cref equal_to function greater greater_equal hash identity invoke less less_equal "
     "minus multiplies negate not_equal_to not_fn plus ref reference_wrapper"},
    {"future", "async future packaged_task promise"},
    {"initializer_list", "initializer_list"},
    {"iomanip", "setfill setprecision setw"},
    {"ios", "defaultfloat dec fixed hex hexfloat ios ios_base left right scientific streamoff streamsize"},
    {"iosfwd",
     "ifstream ios iostream istream istringstream ofstream ostream ostringstream streambuf streamoff streamsize "
     "stringstream"},
    {"iostream", "cerr cin clog cout iostream istream ostream"},
    {"istream", "istream iostream ws"},
    {"iterator",
     "advance back_inserter back_insert_iterator begin data distance end forward_iterator forward_iterator_tag "
     "input_iterator input_iterator_tag inserter istreambuf_iterator iter_reference_t iter_value_t iterator_traits "
     "make_move_iterator make_reverse_iterator move_iterator next prev random_access_iterator "
     "random_access_iterator_tag rbegin rend reverse_iterator size ssize"},
    {"limits", "numeric_limits"},
    {"list", "list"},
    {"locale", "locale"},
    {"map", "erase_if map multimap"},
    {"memory",
     "addressof allocator allocator_traits construct_at default_delete destroy_at enable_shared_from_this "
     "make_shared make_unique make_unique_for_overwrite shared_ptr uninitialized_copy unique_ptr weak_ptr"},
    {"mutex", "adopt_lock call_once lock_guard mutex once_flag recursive_mutex scoped_lock unique_lock"},
    {"new", "align_val_t bad_alloc launder nothrow"},
    {"numbers", "numbers"},
    {"numeric",
     "accumulate adjacent_difference exclusive_scan gcd inclusive_scan inner_product iota lcm midpoint partial_sum "
     "reduce"},
    {"optional", "bad_optional_access make_optional nullopt nullopt_t optional"},
    {"ostream", "endl flush ostream"},
    {"queue", "priority_queue queue"},
    {"random",
     "bernoulli_distribution discrete_distribution mt19937 mt19937_64 normal_distribution random_device seed_seq "
     "uniform_int_distribution uniform_real_distribution"},
    {"ranges", "ranges views"},
    {"set", "erase_if multiset set"},
    {"source_location", "source_location"},
    {"span", "as_bytes as_writable_bytes dynamic_extent span"},
    {"sstream", "istringstream ostringstream stringbuf stringstream"},
    {"stack", "stack"},
    {"stdexcept",
     "domain_error invalid_argument length_error logic_error out_of_range overflow_error range_error runtime_error "
     "underflow_error"},
    {"streambuf", "streambuf"},
    {"string",
     "begin char_traits data end erase erase_if getline size stod stof stoi stol stoll stoul stoull string "
     "to_string u32string u8string"},
    {"string_view", "begin char_traits data end size string_view"},
    {"system_error", "errc error_code error_condition generic_category make_error_code system_category system_error"},
    {"thread", "jthread this_thread thread"},
    {"tuple", "apply forward_as_tuple get make_tuple tie tuple tuple_element tuple_size tuple_size_v"},
    {"type_traits",
     "add_const_t bool_constant common_type_t conditional_t decay_t enable_if_t extent_v false_type "
     "integral_constant invoke_result_t is_aggregate_v is_arithmetic_v is_base_of_v is_class_v is_const_v "
     "is_constant_evaluated is_constructible_v is_convertible_v is_copy_constructible_v is_default_constructible_v "
     "is_empty_v is_enum_v is_floating_point_v is_integral_v is_invocable_r_v is_invocable_v is_lvalue_reference_v "
     "is_nothrow_move_constructible_v is_pointer_v is_reference_v is_rvalue_reference_v is_same is_same_v "
     "is_signed_v is_trivially_copyable_v is_trivially_destructible_v is_unsigned_v is_void_v make_signed_t "
     "make_unsigned_t remove_const_t remove_cv_t remove_cvref_t remove_pointer_t remove_reference_t true_type "
     "type_identity type_identity_t underlying_type_t void_t"},
    {"unordered_map", "erase_if unordered_map unordered_multimap"},
    {"unordered_set", "erase_if unordered_multiset unordered_set"},
    {"utility",
     "as_const cmp_equal cmp_greater cmp_less cmp_less_equal declval exchange forward get in_place in_place_index "
     "in_place_type in_range index_sequence index_sequence_for integer_sequence make_index_sequence make_pair move "
     "pair piecewise_construct swap tuple_element tuple_size tuple_size_v"},
    {"variant",
     "get get_if holds_alternative in_place_index in_place_type monostate variant variant_alternative_t "
     "variant_size_v visit"},
    {"vector", "begin data end erase erase_if size vector"}};

/// The headers that have a name, any of which will do; none: it is not among those above.
inline std::set<std::string_view> headers_of(std::string_view name) {
  static const std::map<std::string_view, std::set<std::string_view>> all = [] {
    std::map<std::string_view, std::set<std::string_view>> result;
    for (const auto& [header, names] : names_of_headers)
      for (std::size_t begin = 0; begin < names.size();) {
        const std::size_t end = std::min(names.find(' ', begin), names.size());
        result[names.substr(begin, end - begin)].insert(header);
        begin = end + 1;
      }
    return result;
  }();
  const auto found = all.find(name);
  return found == all.end() ? std::set<std::string_view>{} : found->second;
}

/// The names that stand behind `std::` in a line that is not in a comment or a text.
inline std::vector<std::string> standard_names_of(std::string_view line) {
  std::vector<std::string> names;
  bool in_text = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '\\') ++k;
    else if (line[k] == '"') in_text = !in_text;
    else if (!in_text && line.substr(k).starts_with("//")) break;
    else if (!in_text && line.substr(k).starts_with("std::")) {
      k += 5;
      const std::size_t end =
          line.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789", k);
      names.emplace_back(line.substr(k, end == std::string_view::npos ? end : end - k));
      k += names.back().size() - 1;
    }
  }
  return names;
}

}  // namespace include_rules
