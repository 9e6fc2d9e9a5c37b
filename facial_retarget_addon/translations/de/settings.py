"""The settings of methods and bakes, as `core.methods.settings` describes them, and the methods themselves."""

TEXTS = {
    "Hierarchical": "Hierarchisch",
    "Hierarchical (Na & Jung): dense motion by correspondence, level by level, with examples": (
        "Hierarchisch (Na & Jung): dichte Bewegung durch Entsprechung, Stufe um Stufe, mit Beispielen"
    ),
    "Feature points (Kshirsagar et al.): MPEG-4 points drive the surface, in each face's own units": (
        "Merkmalspunkte (Kshirsagar u. a.): MPEG-4-Punkte bewegen die Oberfläche, in den Maßen jedes Gesichts"
    ),
    "Motion Cloning": "Motion Cloning",
    "Motion cloning (Pandzic): every shape of a head onto another, in each face's own units": (
        "Motion Cloning (Pandzic): jede Form eines Kopfes auf einen anderen, in den Maßen jedes Gesichts"
    ),
    "Wavelet": "Wavelet",
    "Wavelet (Min & Jung): dense motion in subdivision wavelets, details turned with the target": (
        "Wavelet (Min & Jung): dichte Bewegung in Unterteilungs-Wavelets, Einzelheiten mit dem Ziel gedreht"
    ),
    # Shared by several methods.
    "Levels": "Stufen",
    "Levels over the base mesh: each one holds four times the triangles": (
        "Stufen über der Basismasche: jede hat viermal so viele Dreiecke"
    ),
    "Base Points": "Basispunkte",
    "Base points wanted: what the given ones lack is added between them, matched by the correspondence": (
        "Gewünschte Basispunkte: was den gegebenen fehlt, kommt dazwischen hinzu, zugeordnet durch die Entsprechung"
    ),
    "Base Gain": "Basisstärke",
    "Strength of the coarse motion, carried by the base mesh": (
        "Stärke der groben Bewegung, die die Basismasche trägt"
    ),
    "Level Gains": "Stufenstärken",
    "Strength of the motion that each level adds, level 1 first; missing ones are 1": (
        "Stärke der Bewegung, die jede Stufe hinzufügt, Stufe 1 zuerst; fehlende sind 1"
    ),
    "Detail Scale": "Feinheiten",
    "Strength of what is finer than the last level, wrinkles above all": (
        "Stärke dessen, was feiner als die letzte Stufe ist, vor allem Falten"
    ),
    "Example Strength": "Beispielstärke",
    "How far the examples steer the result": "Wie weit die Beispiele das Ergebnis lenken",
    "Variant": "Variante",
    "Default": "Standard",
    "Paper": "Aufsatz",
    # Hierarchical.
    "default: dense motion with example residuals; paper: the published formulas": (
        "Standard: dichte Bewegung mit Resten der Beispiele; Aufsatz: die veröffentlichten Formeln"
    ),
    "Read": "Lesen",
    "track: the source keeps its topology and its points are followed; pierce: every frame is pierced anew": (
        "Verfolgen: die Quelle behält ihre Topologie, und ihre Punkte werden verfolgt; Durchstoßen: jedes Bild wird "
        "neu durchstoßen"
    ),
    "Track": "Verfolgen",
    "Pierce": "Durchstoßen",
    "How motion turns: with the surface around each place, or with the heads as a whole": (
        "Wie Bewegung sich dreht: mit der Oberfläche um jede Stelle, oder mit den Köpfen als Ganzem"
    ),
    "Local": "Lokal",
    "Global": "Global",
    # Feature points.
    "Motion": "Bewegung",
    "free: every common point moves along all three axes; faps: only what MPEG-4's parameters can say": (
        "Frei: jeder gemeinsame Punkt bewegt sich entlang aller drei Achsen; FAPs: nur, was die Parameter von MPEG-4 "
        "sagen können"
    ),
    "Free": "Frei",
    "Faps": "FAPs",
    "default: continuous weights, lids that shut; paper: the published weights": (
        "Standard: stetige Gewichte, Lider, die schließen; Aufsatz: die veröffentlichten Gewichte"
    ),
    # Motion cloning.
    "local: one scale for the heads, motion turns with the surface; regional: every region by its own size; "
    "compliant: that along the axes of the heads, as MPEG-4's parameters want it": (
        "Lokal: ein Maßstab für die Köpfe, Bewegung dreht sich mit der Oberfläche; Regional: jeder Bereich nach "
        "seiner Größe; Konform: dies entlang der Achsen der Köpfe, wie die Parameter von MPEG-4 es wollen"
    ),
    "Regional": "Regional",
    "Compliant": "Konform",
    "default: places found on the surfaces, continuous units; paper: the published cylinder and regions": (
        "Standard: auf den Oberflächen gefundene Stellen, stetige Maße; Aufsatz: Zylinder und Bereiche wie "
        "veröffentlicht"
    ),
    # Wavelet.
    "Mode": "Modus",
    "framed: details scale and turn with the target's surface; scaled: they scale only; paper: as published, pasted "
    "as they are": (
        "Gedreht: Einzelheiten skalieren und drehen sich mit der Oberfläche des Ziels; Skaliert: sie skalieren nur; "
        "Aufsatz: wie veröffentlicht, unverändert aufgesetzt"
    ),
    "Framed": "Gedreht",
    "Scaled": "Skaliert",
    "Source Mesh": "Quellmasche",
    "Where the source is read: matched: at the counterparts of the target's fine vertices; pierced: on a fine mesh "
    "made for the source by itself": (
        "Wo die Quelle gelesen wird: Zugeordnet: an den Gegenstücken der feinen Eckpunkte des Ziels; Durchstoßen: auf "
        "einer feinen Masche, die für die Quelle allein gemacht ist"
    ),
    "Matched": "Zugeordnet",
    "Pierced": "Durchstoßen",
    "Lifting": "Lifting",
    "disc: wavelets nearly orthogonal to the coarser levels; integral: wavelets without a mean, for comparison": (
        "Scheibe: Wavelets, die fast rechtwinklig zu den gröberen Stufen sind; Integral: Wavelets ohne Mittelwert, "
        "zum Vergleich"
    ),
    "Disc": "Scheibe",
    "Integral": "Integral",
    "Edges around a new vertex over which its wavelet is made orthogonal": (
        "Kanten um einen neuen Eckpunkt, über die sein Wavelet rechtwinklig gemacht wird"
    ),
    # Regions.
    "Brows": "Brauen",
    "Strength of the motion of brows and forehead": "Stärke der Bewegung von Brauen und Stirn",
    "Eyes": "Augen",
    "Strength of the motion of the lids; eyeballs look where they look": (
        "Stärke der Bewegung der Lider; Augäpfel blicken, wohin sie blicken"
    ),
    "Nose": "Nase",
    "Strength of the motion of the nose": "Stärke der Bewegung der Nase",
    "Cheeks": "Wangen",
    "Strength of the motion of the cheeks": "Stärke der Bewegung der Wangen",
    "Mouth": "Mund",
    "Strength of the motion of the lips and around them": "Stärke der Bewegung der Lippen und ihrer Umgebung",
    "Jaw": "Kiefer",
    "Strength of the motion of chin, jaw, lower teeth and tongue": (
        "Stärke der Bewegung von Kinn, Kiefer, unteren Zähnen und Zunge"
    ),
    # Bakes.
    "Tolerance": "Toleranz",
    "How far a frame of a compact bake may be off, in distances between the eyes": (
        "Wie weit ein Bild beim kompakten Backen daneben liegen darf, in Augenabständen"
    ),
    "Smoothness": "Weichheit",
    "How much the curves of a rig are kept from bending from frame to frame": (
        "Wie sehr die Kurven eines Rigs davon abgehalten werden, sich von Bild zu Bild zu biegen"
    ),
    "Sparsity": "Sparsamkeit",
    "How much the curves of a rig are kept at zero where others do nearly as well": (
        "Wie sehr die Kurven eines Rigs bei null gehalten werden, wo andere fast dasselbe leisten"
    ),
    "Residual": "Rest",
    "Frames that share one more shape key for what a rig's own cannot do; 0: no such keys": (
        "Bilder, die sich einen weiteren Formschlüssel teilen für das, was die eigenen nicht können; 0: keine solchen"
    ),
}
