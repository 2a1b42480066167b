"""The sentences of an electrical plan in English."""

ELECTRIC = {
    "electric.title": "Electrical plan",
    "electric.lead": "Supply, motors with fuses and wires by current, sensors, terminals, safety circuit",
    "electric.supply": "Supply",
    "electric.supply-how": "All motors at their rated power. The main switch is lockable and separates all live "
    "wires; its handle is before the door, {height} over the floor (IEC 60204-1, 5.3: 0.6 to 1.9 m).",
    "electric.what": "what",
    "electric.value": "value",
    "electric.mains": "mains",
    "electric.connected": "connected load",
    "electric.mean": "mean power while it weaves",
    "electric.main-fuse": "main fuses",
    "electric.main-wire": "wires from the mains",
    "electric.motors": "Motors",
    "electric.motors-how": "Amplifiers of servos up to 2 kW on a phase and N, of larger ones on three phases; those "
    "of steppers on 48 V. The current is that of the windings; each fuse carries 1.25 times what its amplifier draws, "
    "each wire the fuse's rating: copper in PVC, method B2 at 40 °C, IEC 60204-1, 12.4 and table 6, with the factor "
    "of the cables that lie together.",
    "electric.motor": "motor",
    "electric.designation": "designation",
    "electric.pieces": "pieces",
    "electric.power": "rated power",
    "electric.current": "current [A]",
    "electric.fuse": "fuse [A]",
    "electric.section": "section [mm²]",
    "electric.together": "cables together",
    "electric.sensors": "Sensors",
    "electric.device": "device",
    "electric.signals": "signals",
    "electric.terminals": "Signals",
    "electric.terminals-how": "Every signal of the control that has an address (io.csv): those with an input come "
    "over a wire, all others pass between the programs in the motion controller A1.",
    "electric.signal": "signal",
    "electric.terminal": "terminal",
    "electric.parts": "parts",
    "electric.safety": "Safety circuit",
    "electric.safety-how": "{stops} and {guards}, {relay}: emergency stops open both channels of {stops}, guards those "
    "of {guards}; their contacts are in series. A relay that opens halts the motion controller at once over {halt}, "
    "which brakes all axes (stop category 1 of IEC 60204-1), and then takes the torque from all amplifiers. The "
    "circuit responds in {circuit}; the last axis, {axis}, stands after {whole}.",
    "electric.residual": "Amplifiers keep a dangerous voltage after they are switched off: measure below 60 V before "
    "their covers are opened (IEC 60204-1, 6.2.4).",
    "electric.single-line": "Supply and motors in a single line",
    "electric.direct": "{volts} direct current",
    "electric.brakes": "Brakes",
    "electric.brakes-how": "A brake holds what would sink; its amplifier releases it with the torque and lets it fall "
    "when the torque is taken off.",
    "electric.feeds": "What feeds what",
    "electric.consumer": "consumer",
    "electric.volts": "voltage [V]",
    "electric.all-power": "power of all",
    "electric.fed-by": "fed by",
    "electric.source": "{sign}, {row}: loaded with {load} of {rated}; bars have at least {bar} mm² of copper.",
    "electric.braking": "The braking module R1 on the bars of 48 V burns what steppers give back while they brake.",
    "electric.braking-title": "Braking",
    "electric.braking-how": "What a motor gives back, with its rotor and without friction: the capacitors of its "
    "amplifier store it for the next acceleration, or a resistor burns its mean power.",
    "electric.stop-energy": "energy of a stop",
    "electric.mean-braking": "mean power",
    "electric.stored": "stored",
    "electric.burnt": "resistor",
    "electric.channels": "Inputs of the modules",
    "electric.channels-how": "Each module is on the bus of the motion controller A1. A sensor without a signal it "
    "reports by its number in TieStatus and EndStatus.",
    "electric.module": "module",
    "electric.inputs": "inputs",
    "electric.piece": "pieces, by number",
    "electric.connected-at": "connected at",
    "electric.cabinet": "Cabinet",
    "electric.cabinet-how": "{size} mm of sheet steel, IP54; with all that stands in it {mass}. Its devices lose "
    "{heat} at their rated power, which walls and fan carry at {rise} over the room.",
    "electric.enabling-how": "At setting the mode selector {mode}, whose key is taken out, puts both channels of the "
    "enabling switch {sign} in the position of those of the guards alone, and takes the inputs of full speed from all "
    "amplifiers: their safely limited speed (SLS of IEC 61800-5-2, 250 mm/s at most) watches the axis that jogs "
    "(IEC 60204-1, 9.2.3.5 and 9.2.4). Emergency stops act in both modes.",
    "electric.sign": "sign",
    "electric.amplifier": "amplifier [A]",
    "electric.relay": "safety relay",
    "electric.reset": "reset {sign}",
    "electric.halt": "halt, at once",
    "electric.amplifiers": "amplifiers",
    "electric.feedback": "feedback",
    "electric.input": "input",
    "electric.phase": "phase",
    "electric.phases": "currents of the phases",
    "electric.strips": "Terminals",
    "electric.strips-how": "X0: L1, L2, L3, N, PE of the mains. X1: signals. X2: 24 V and 0 V. X3: safety circuit, "
    "with its channel. Each run of terminals has the pieces of a device in their order. Leads of motors, brakes and "
    "encoders go to their amplifiers whole.",
    "electric.strip": "strip",
    "electric.terminals-of": "terminals",
    "electric.wires": "wires",
    "electric.protected": "Channels of 24 V",
    "electric.protected-how": "The protector F24 feeds groups of consumers: coils of brakes and solenoids, safety "
    "circuit, sensors with the modules on the heads, control in the cabinet.",
    "electric.channel": "channel",
    "electric.group": "group",
    "electric.rating": "rating [A]",
    "electric.coils": "coils",
    "electric.safety-group": "safety circuit",
    "electric.sensors-group": "sensors",
    "electric.control": "control",
    "electric.cables": "Cables",
    "electric.cables-how": "Lengths of the longest and of all: along the three axes from the cabinet to the device, "
    "through its energy chain where it rides on a head, {spare} more, and {inside} in the cabinet. Numbers and "
    "sections of wires by IEC 60204-1, table 5; S: screened.",
    "electric.from": "from",
    "electric.to": "to",
    "electric.cable": "cable",
    "electric.longest": "longest",
    "electric.whole-length": "all",
    "electric.in-series": "all, in series",
}
