"""How the first blow of a drop grows with the clearance, one run a clearance."""

from pathlib import Path

import auxbear

drop = auxbear.Scenario.load(Path(__file__).parents[2] / "scenarios" / "reference_drop.toml")
drop.set("run.duration", "30 ms")

for clearance in ["0.1 mm", "0.2 mm", "0.3 mm"]:
    result = drop.copy().set("contact.radial_air_clearance", clearance).run()
    print(f"{clearance}: {result['first_impact_force']}")
