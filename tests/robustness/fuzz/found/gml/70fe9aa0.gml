<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:gml="http://www.opengis.net/gml">
<gml:boundedBy><gml:Envelope srsNamf="#f0"/><gml:surfaceMember xlink:=fehr"#f2"/><gml:surfaceMember xlink:href="#f3l:posList>1000000450000 0 100000 450003 0 100004 450003 0 100004 450000 0 100000 450000 0</gml:pceMember></gml:MultiSurface></bldg:lod2MultiSutygml/2.0" xmlns:gml="http://www.opengis.net/gml">
<gml:boundedBy><gml:Envelope srsName="urn:ogc:fef:crs:EPSG::28992" srsDimension="3"><gml:low<gml:LinearRing><gml:posList>100004 450000 0 1e0r0