"""What FMI allows in modelDescription.xml of a co-simulation, and in buildDescription.xml: our own reading of the
standard (FMI 2.0 section 2.2, FMI 3.0 sections 2.4 and 2.5), since neither Debian nor npm has its XSD. What is not
listed here is not allowed, so that a name that is misspelt is found.
"""
import re


def whole(text, lowest=None):
    return re.fullmatch(r"[-+]?\d+", text) is not None and (lowest is None or int(text) >= lowest)


def number(text):
    return re.fullmatch(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?|NaN|-?INF", text) is not None


def one_of(*words):
    return lambda text: text in words


def any_text(_):
    return True


boolean = one_of("true", "false", "0", "1")
unsigned = lambda text: whole(text, 0)  # noqa: E731
positive = lambda text: whole(text, 1)  # noqa: E731
identifier = lambda text: re.fullmatch(r"[A-Za-z_]\w*", text) is not None  # noqa: E731
some = lambda text: text.strip() != ""  # noqa: E731
SI = {unit: whole for unit in ("kg", "m", "s", "A", "K", "mol", "cd", "rad")}
UNIT = {"Unit": ({"name!": some}, ["BaseUnit?", "DisplayUnit*"]),
        "BaseUnit": ({**SI, "factor": number, "offset": number}, []),
        "DisplayUnit": ({"name!": some, "factor": number, "offset": number}, [])}
CATEGORY = {"LogCategories": ({}, ["Category+"]), "Category": ({"name!": some, "description": any_text}, [])}
EXPERIMENT = {"DefaultExperiment": ({key: number for key in ("startTime", "stopTime", "tolerance", "stepSize")}, [])}
ABOUT = {"modelName!": some, "description": any_text, "author": any_text, "version": any_text, "copyright": any_text,
         "license": any_text, "generationTool": any_text, "generationDateAndTime": any_text,
         "variableNamingConvention": one_of("flat", "structured")}
RUNS = {key: boolean for key in ("needsExecutionTool", "canHandleVariableCommunicationStepSize",
                                 "canBeInstantiatedOnlyOncePerProcess")}
VARIABLE = {"name!": some, "valueReference!": unsigned, "description": any_text,
            "variability": one_of("constant", "fixed", "tunable", "discrete", "continuous"),
            "canHandleMultipleSetPerTimeInstant": boolean}
INITIAL = one_of("exact", "approx", "calculated")
WHOLE = {"declaredType": some, "quantity": any_text, "min": whole, "max": whole, "start": whole}
REAL = {**{key: number for key in ("min", "max", "nominal", "start")}, "declaredType": some, "quantity": any_text,
        "unit": some, "displayUnit": some, "relativeQuantity": boolean, "unbounded": boolean, "derivative": unsigned,
        "reinit": boolean}
KINDS = one_of("dependent", "constant", "fixed", "tunable", "discrete")
kinds = lambda text: all(map(KINDS, text.split()))  # noqa: E731
references = lambda text: all(map(unsigned, text.split()))  # noqa: E731
CAUSES = ("parameter", "calculatedParameter", "input", "output", "local", "independent")

# Of each element its attributes, with ! where they must be there, and its children in their order.
TWO = {
    **UNIT, **CATEGORY, **EXPERIMENT,
    "fmiModelDescription": ({**ABOUT, "fmiVersion!": one_of("2.0"), "guid!": some, "numberOfEventIndicators": unsigned},
                            ["CoSimulation+", "UnitDefinitions?", "LogCategories?", "DefaultExperiment?", "ModelVariables",
                             "ModelStructure"]),
    "CoSimulation": ({**RUNS, "modelIdentifier!": identifier, "canInterpolateInputs": boolean,
                      "maxOutputDerivativeOrder": unsigned, "canRunAsynchronuously": boolean,
                      "canNotUseMemoryManagementFunctions": boolean, "canGetAndSetFMUstate": boolean,
                      "canSerializeFMUstate": boolean, "providesDirectionalDerivative": boolean}, []),
    "UnitDefinitions": ({}, ["Unit+"]),
    "ModelVariables": ({}, ["ScalarVariable+"]),
    "ScalarVariable": ({**VARIABLE, "causality": one_of(*CAUSES), "initial": INITIAL}, ["Real?", "Integer?"]),
    "Real": (REAL, []), "Integer": (WHOLE, []),
    "ModelStructure": ({}, ["Outputs?", "Derivatives?", "DiscreteStates?", "InitialUnknowns?"]),
    "Outputs": ({}, ["Unknown+"]), "InitialUnknowns": ({}, ["Unknown+"]),
    "Unknown": ({"index!": positive, "dependencies": references, "dependenciesKind": kinds}, []),
}
KNOWN3 = {"valueReference!": unsigned, "dependencies": references, "dependenciesKind": kinds}
MORE3 = {"causality": one_of(*CAUSES, "structuralParameter"), "initial": INITIAL, "intermediateUpdate": boolean,
         "previous": unsigned, "clocks": references}
THREE = {
    **UNIT, **CATEGORY, **EXPERIMENT,
    "fmiModelDescription": ({**ABOUT, "fmiVersion!": lambda text: re.fullmatch(r"3\.\d+(\.\d+)?(-.+)?", text),
                             "instantiationToken!": some},
                            ["CoSimulation", "UnitDefinitions?", "LogCategories?", "DefaultExperiment?", "ModelVariables",
                             "ModelStructure"]),
    "CoSimulation": ({**RUNS, "modelIdentifier!": identifier, "canGetAndSetFMUState": boolean, "canSerializeFMUState": boolean,
                      "providesDirectionalDerivatives": boolean, "providesAdjointDerivatives": boolean,
                      "providesPerElementDependencies": boolean, "maxOutputDerivativeOrder": unsigned,
                      "providesIntermediateUpdate": boolean, "mightReturnEarlyFromDoStep": boolean,
                      "canReturnEarlyAfterIntermediateUpdate": boolean, "fixedInternalStepSize": number,
                      "recommendedIntermediateInputSmoothness": whole, "hasEventMode": boolean,
                      "providesEvaluateDiscreteStates": boolean}, []),
    "UnitDefinitions": ({}, ["Unit*"]),
    "ModelVariables": ({}, ["Float64*", "Int64*"]),
    "Float64": ({**VARIABLE, **MORE3, **REAL}, []), "Int64": ({**VARIABLE, **MORE3, **WHOLE}, []),
    "ModelStructure": ({}, ["Output*", "ContinuousStateDerivative*", "ClockedState*", "InitialUnknown*", "EventIndicator*"]),
    "Output": (KNOWN3, []), "InitialUnknown": (KNOWN3, []),
}
BUILD = {
    "fmiBuildDescription": ({"fmiVersion!": one_of("3.0")}, ["BuildConfiguration+"]),
    "BuildConfiguration": ({"modelIdentifier!": identifier, "platform": some, "description": any_text},
                           ["SourceFileSet*", "PreprocessorDefinition*", "IncludeDirectory*", "Library*"]),
    "SourceFileSet": ({"name": some, "language": some, "compiler": some, "compilerOptions": any_text},
                      ["SourceFile+", "PreprocessorDefinition*", "IncludeDirectory*"]),
    "SourceFile": ({"name!": some}, []), "IncludeDirectory": ({"name!": some}, []),
    "PreprocessorDefinition": ({"name!": some, "value": any_text, "optional": boolean, "description": any_text}, []),
    "Library": ({"name!": some, "version": any_text, "external": boolean, "description": any_text}, []),
}

# Which variability goes with which causality, and what `initial` may then be; the first if it is left out.
ALLOWED = {("parameter", "fixed"): ("exact",), ("parameter", "tunable"): ("exact",),
           ("input", "discrete"): (None,), ("input", "continuous"): (None,), ("independent", "continuous"): (None,),
           ("output", "constant"): ("exact",), ("output", "discrete"): ("calculated", "exact", "approx"),
           ("output", "continuous"): ("calculated", "exact", "approx")}
# Names of the structured convention, `a.b[1].c`.
STRUCTURED = re.compile(r"[A-Za-z_]\w*(\[\d+(,\d+)*\])?(\.[A-Za-z_]\w*(\[\d+(,\d+)*\])?)*")


def shape(element, rules):
    """What is wrong with an element and those in it, by the lists above."""
    if element.tag not in rules:
        return [f"unknown element {element.tag}"]
    attributes, children = rules[element.tag]
    said = [f"{element.tag}: {key[:-1]} is missing" for key in attributes if key.endswith("!") and key[:-1] not in element.keys()]
    known = {key.rstrip("!"): right for key, right in attributes.items()}
    for key, value in element.items():
        if key not in known:
            said.append(f"{element.tag}: unknown attribute {key}")
        elif not known[key](value):
            said.append(f"{element.tag}: {key} = {value}")
    # Those of variables may come in any order, others in theirs.
    tags = "".join(f"<{child.tag}>" for child in element)
    order = "".join(f"(<{one.rstrip('?*+')}>){one[len(one.rstrip('?*+')):]}" for one in children)
    mixed = element.tag == "ModelVariables" and all(f"{child.tag}*" in children for child in element)
    if not mixed and not re.fullmatch(order, tags):
        said.append(f"{element.tag}: {tags} are not {children}")
    return said + [one for child in element for one in shape(child, rules)]


def of_variable(variable, typed, units):
    name, causality = variable.get("name"), variable.get("causality", "local")
    said = [] if STRUCTURED.fullmatch(name) else ["is no name of the structured convention"]
    real = typed.tag in ("Real", "Float64")
    variability = variable.get("variability", "continuous" if real else "discrete")
    if variability == "continuous" and not real:
        said.append("only what is real is continuous")
    initials = ALLOWED.get((causality, variability))
    if initials is None:
        return [f"{name}: {causality} cannot be {variability}"]
    initial = variable.get("initial", initials[0])
    if initial not in initials:
        said.append(f"initial = {initial}")
    must = causality == "input" or variability == "constant" or initial in ("exact", "approx")
    if must != (typed.get("start") is not None):
        said.append("start is missing" if must else "start has no meaning")
    ends = [float(typed.get(key)) for key in ("min", "start", "max") if typed.get(key) is not None]
    if ends != sorted(ends):
        said.append("min, start and max do not ascend")
    if typed.get("unit") is not None and typed.get("unit") not in units:
        said.append(f"unit {typed.get('unit')} is not defined")
    return [f"{name}: {one}" for one in said]


def complaints(description):
    """All that is wrong with a modelDescription.xml, by its root; nothing if it is right."""
    two = description.get("fmiVersion") == "2.0"
    said = shape(description, TWO if two else THREE)
    if said:
        return said
    variables = list(description.find("ModelVariables"))
    units = [unit.get("name") for unit in description.iterfind("UnitDefinitions/Unit")]
    for what, words in (("name", [one.get("name") for one in variables]), ("unit", units),
                        ("valueReference", [one.get("valueReference") for one in variables])):
        said += [f"{what} {word} is there twice" for word in sorted({word for word in words if words.count(word) > 1})]
    for variable in variables:
        said += of_variable(variable, variable[0] if two else variable, units)
    if sum(one.get("causality") == "independent" for one in variables) > 1:
        said.append("time is there twice")
    key = "index" if two else "valueReference"
    outputs = [str(i) if two else one.get(key) for i, one in enumerate(variables, 1) if one.get("causality") == "output"]
    structure = description.find("ModelStructure")
    for tag in ("Outputs/Unknown", "InitialUnknowns/Unknown") if two else ("Output", "InitialUnknown"):
        if [unknown.get(key) for unknown in structure.iterfind(tag)] != outputs:
            said.append(f"{tag} are not all outputs, once and in order")
    return said
