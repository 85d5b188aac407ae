"""Lists what there is to choose from, with what each guarantees."""

import outrider

for name, row in outrider.pursuit_planners().items():
    print(f"{name}: {row['guarantee']}")
print(", ".join(outrider.cover_methods()))
print(", ".join(outrider.explore_strategies()))
print(", ".join(outrider.guard_planners()))

# Prints:
# optimal: complete; the least cost of all catches, or the proof that there is none
# anytime: complete; never dearer with more budget, and the least cost when none is set
# boustrophedon, spiral, quickest
# tour, information_gain, nearest
# best_tour
