// The solver and the discrete form of every layout are compiled here, and only here.
#include "cd/discrete/discrete_form.hpp"
#include "cd/solvers/nsgs.hpp"

namespace galet::cd {

template class Nsgs<Layout{2, false}>;
template class DiscreteForm<Layout{2, false}>;
template class Nsgs<Layout{2, true}>;
template class DiscreteForm<Layout{2, true}>;
template class Nsgs<Layout{2, true, true}>;
template class DiscreteForm<Layout{2, true, true}>;
template class Nsgs<Layout{3, false}>;
template class DiscreteForm<Layout{3, false}>;
template class Nsgs<Layout{3, true}>;
template class DiscreteForm<Layout{3, true}>;
template class Nsgs<Layout{3, true, true}>;
template class DiscreteForm<Layout{3, true, true}>;

}  // namespace galet::cd
