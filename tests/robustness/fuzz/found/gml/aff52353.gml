<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.opengis.net/citygml/1.0" xmlns:gml="http://www.opengis.net/gml">
<gml:boundedBy><gml:Envelope srsName="urn:ogc:def:crs:EPf0"><gml:etiexror><gml:LinearRing><gml:posList>100000 450000 0 100000 450003 0 1000~4 450003 0 100004 4500gml:SoliN5osgeo4proj9operation19Coordd></bldg:lod2Solid><bldgdel>
